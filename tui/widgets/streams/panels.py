"""The panels of running commands, side by side below the panes, as many as fit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.command_line import Stream
from bot_console.tui.console.command_line_limits import goes_on
from bot_console.tui.keys.key import key_text
from bot_console.tui.widgets.streams.panel import StreamPanel
from textual.containers import Container
from textual.geometry import Size

MIN_COLUMNS = 30
"""Minimum columns of a panel beside others; the output of `topic echo` is narrow and long."""
MAX_PANEL_ROWS, MIN_PANEL_ROWS = 8, 5
"""Maximum and minimum rows of a panel, with its border."""
CHROME_ROWS = 3
"""Rows of the terminal for tabs, status line and key bar; panels take at most half of the rest."""
MAX_STREAMS = 6
"""Maximum number of running commands, in a terminal of any size."""


def _across(size: Size) -> int:
    return max(1, size.width // MIN_COLUMNS)


def _down(size: Size) -> int:
    return max(MIN_PANEL_ROWS, (size.height - CHROME_ROWS) // 2)


def room(size: Size) -> int:
    """The number of panels that fit in a terminal of a size."""
    return min(MAX_STREAMS, _across(size) * (_down(size) // MIN_PANEL_ROWS))


class StreamPanels(Container):
    """Holds the panels of streams, oldest first; hidden while there is none."""

    DEFAULT_CSS = """
    StreamPanels { display: none; layout: grid; height: 8; grid-gutter: 0; }
    StreamPanels.open { display: block; layout: grid; }
    """
    can_focus: ClassVar[bool] = False  # pyright: ignore[reportIncompatibleVariableOverride] -- as Textual's widgets do

    def __init__(self) -> None:
        super().__init__()
        self._panels: list[StreamPanel] = []
        self._key = key_text(next(each for each in keymap.TABLE["app"] if each.action == "end_stream"))
        self._laid_out: tuple[object, ...] = ()
        self._rows = MAX_PANEL_ROWS

    @property
    def panels(self) -> Sequence[StreamPanel]:
        """The panels, oldest first."""
        return self._panels

    @property
    def _terminal(self) -> Size:
        return self.app.size  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic

    def problem(self, words: Sequence[str]) -> str:
        """Why a `ros2` command (its words without `ros2`) cannot be started; empty if it can."""
        if not goes_on(words) or any(each.has_ended for each in self._panels):
            return ""
        has = room(self._terminal)
        if len(self._panels) < has:
            return ""
        larger = "" if has >= MAX_STREAMS else ", a larger terminal has more room"
        return f"no room: {len(self._panels)} commands are running; {self._key} ends one{larger}"

    def begin(self, line: str, stream: Stream) -> None:
        """Show a stream; if there is no room for it, remove the oldest one that has ended."""
        if len(self._panels) >= room(self._terminal):
            ended = [each for each in self._panels if each.has_ended]
            for each in ended[:1]:
                self.end(each)
        panel = StreamPanel(line, stream)
        self._panels.append(panel)
        self.mount(panel)
        self.poll()

    def end(self, panel: StreamPanel) -> None:
        """End a stream and remove its panel."""
        if panel in self._panels:
            self._panels.remove(panel)
            panel.stop()
            panel.remove()
            self.poll()

    def on_unmount(self) -> None:
        """End the streams with the console."""
        for each in self._panels:
            each.stop()

    def poll(self) -> None:
        """Show new lines; first lay out the panels if they or the terminal's size have changed."""
        now = (self._terminal, *((each, each.state) for each in self._panels))
        if now != self._laid_out:
            self._laid_out = now
            self._lay_out(self._terminal)
        for each in self._panels:
            each.poll(self._rows)

    def _lay_out(self, size: Size) -> None:
        self.set_class(bool(self._panels), "open")
        # If the terminal has become smaller, only the newest panels are visible; the others keep running.
        seen = self._panels[-room(size) :]
        for number, each in enumerate(self._panels, 1):
            each.display = each in seen
            each.set_title(number if len(self._panels) > 1 else 0, self._key)
            each.styles.column_span = 1
        if not seen:
            return
        rows = math.ceil(len(seen) / _across(size))
        columns = math.ceil(len(seen) / rows)
        self._rows = min(MAX_PANEL_ROWS, _down(size) // rows)
        self.styles.height = rows * self._rows
        self.styles.grid_size_columns, self.styles.grid_size_rows = columns, rows
        seen[-1].styles.column_span = 1 + rows * columns - len(seen)
        if len(seen) < len(self._panels):
            seen[-1].border_subtitle = f"{len(self._panels) - len(seen)} more not shown · {self._key} closes one"

    def on_stream_panel_closed(self, event: StreamPanel.Closed) -> None:
        """End the stream of a panel whose title was clicked."""
        event.stop()
        self.end(event.panel)
