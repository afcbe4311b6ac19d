"""Makes panes for the system being shown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from bot_console.tui.console.protocol import Console
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.time_cursor import TimeCursor

P = TypeVar("P", bound=Pane)


class PaneMaker:
    """Makes panes that share the console's ports and the time cursor."""

    def __init__(self, console: Console, time_cursor: TimeCursor, entries: Callable[[], Sequence[PaneEntry]]) -> None:
        """`entries` returns all available panes."""
        self._console = console
        self._time_cursor = time_cursor
        self.entries = entries

    def make(self, kind: type[P], id: str, **facts: Any) -> P:
        """Make a pane of a class."""
        return kind(self._console, id=id, time_cursor=self._time_cursor, **facts)
