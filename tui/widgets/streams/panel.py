"""The panel of a running command, with its last lines of output; it never takes the focus."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from bot_console.tui.console.command_line import Stream
from bot_console.tui.text.sanitize import sanitize
from rich.text import Text
from textual.events import Click
from textual.message import Message
from textual.widgets import Static

BORDER_ROWS = 2
"""Rows that the border takes."""


class StreamPanel(Static):
    """Shows the newest lines of one stream."""

    DEFAULT_CSS = """
    StreamPanel { height: 1fr; width: 1fr; border: round $border; border-title-color: $text-muted;
                  border-subtitle-color: $text-muted; background: $surface; text-wrap: nowrap;
                  text-overflow: ellipsis; }
    """
    can_focus: ClassVar[bool] = False  # pyright: ignore[reportIncompatibleVariableOverride] -- as Textual's widgets do

    class Closed(Message):
        """The title was clicked."""

        def __init__(self, panel: StreamPanel) -> None:
            super().__init__()
            self.panel = panel

    def __init__(self, line: str, stream: Stream) -> None:
        super().__init__("", markup=False)
        self.line = line
        self._stream = stream
        self._shown: Sequence[str] = ()
        self._rows = 0

    @property
    def state(self) -> str:
        """The state of the stream in words."""
        return "has ended" if self._stream.ended else "runs"

    @property
    def has_ended(self) -> bool:
        """Whether the stream has ended."""
        return self._stream.ended

    def set_title(self, number: int, key: str) -> None:
        """Set the title to the command and its state; `number` is the number among several panels, or 0."""
        named = self.line.removeprefix("ros2 ") if number else self.line
        title = f"{number} {named}" if number else f"{named} · {self.state} · {key} closes"
        self.border_title = Text(sanitize(title))  # Textual parses a str as markup, but brackets in a line are literal
        # Beside other panels, the title has no room for both.
        self.border_subtitle = f"{self.state} · {key} closes one" if number else ""

    def poll(self, rows: int) -> None:
        """Show the newest lines that fit in a number of rows."""
        lines = self._stream.lines()
        if lines is not self._shown or rows != self._rows:
            self._shown, self._rows = lines, rows
            self.update(Text("\n".join(sanitize(each) for each in lines[-max(1, rows - BORDER_ROWS) :])))

    def stop(self) -> None:
        """End the stream."""
        self._stream.stop()

    def on_click(self, event: Click) -> None:
        """Close the panel on a click on its title."""
        event.stop()
        if event.y == 0:
            self.post_message(self.Closed(self))
