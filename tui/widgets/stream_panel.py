"""A command line that goes on, below the panes: its last lines, and no keyboard of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.protocol import Stream
from bot_console.tui.format import harmless
from bot_console.tui.keys.key import key_text
from rich.text import Text
from textual.widgets import Static

SHOWN = 6
"""Lines that are seen."""


class StreamPanel(Static):
    """Shows the newest lines of one stream; hidden while there is none."""

    DEFAULT_CSS = """
    StreamPanel { display: none; height: 8; border: round $border; border-title-color: $text-muted;
                  background: $surface; text-wrap: nowrap; text-overflow: ellipsis; }
    StreamPanel.open { display: block; }
    """
    can_focus: ClassVar[bool] = False  # pyright: ignore[reportIncompatibleVariableOverride] -- as Textual's widgets do

    def __init__(self) -> None:
        super().__init__("", markup=False)
        self._line = ""
        self._stream: Stream | None = None
        self._shown: Sequence[str] = ()
        self._told_end = False

    @property
    def is_open(self) -> bool:
        """Whether a stream is shown."""
        return self._stream is not None

    def begin(self, line: str, stream: Stream) -> None:
        """Show a stream; the one before is ended."""
        self.end()
        self._line, self._stream, self._shown, self._told_end = line, stream, (), False
        self.update("")
        self.border_title = self._title("runs")
        self.add_class("open")

    def look(self) -> None:
        """Show what has come."""
        if self._stream is None:
            return
        ended, lines = self._stream.ended, self._stream.lines()
        if ended and not self._told_end:
            self._told_end = True
            self.border_title = self._title("has ended")
        if lines is not self._shown:
            self._shown = lines
            self.update(Text("\n".join(harmless(each) for each in lines[-SHOWN:])))

    def end(self) -> None:
        """End the stream, and hide."""
        if self._stream is not None:
            self._stream.stop()
            self._stream = None
            self.remove_class("open")

    def _title(self, state: str) -> str:
        key = next(each for each in keymap.TABLE["app"] if each.action == "end_stream")
        return f"{harmless(self._line).replace('[', '(')} · {state} · {key_text(key)} closes"
