"""The rows of the diagnostics pane as they are drawn: name, level, message, age."""

from __future__ import annotations

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.sensors.diagnostic_status import Level
from bot_console.tui.panes.diagnostics.tree import Row, matches
from bot_console.tui.text.figures import age_text
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment
from textual.events import Click
from textual.message import Message

LEVEL_STYLES = {
    Level.OK: ("●", "good"),
    Level.WARN: ("▲", "warn"),
    Level.ERROR: ("✗", "error"),
    Level.STALE: ("◌", "warn"),
}
"""Sign and style of each level; its name is written beside it, so that colour alone never carries the meaning."""
LEVEL_CELLS, AGE_CELLS = 7, 6
"""Cells of the level and of the age."""
MAX_NAME_CELLS = 40
"""Maximum cells of a name."""


class StatusRows(ItemList[Row]):
    """One part of the robot per row."""

    class Pressed(Message):
        """The selected row, or a fold mark, was clicked."""

        def __init__(self, on_mark: bool) -> None:
            super().__init__()
            self.on_mark = on_mark

    def __init__(self) -> None:
        super().__init__()
        self._names: tuple[object, int] = (None, 0)

    def key(self, item: Row) -> object:
        """The part's path."""
        return item.path

    def on_click(self, event: Click) -> None:
        """Select the clicked row; post `Pressed` for its fold mark, or if it was selected already."""
        event.prevent_default()  # as in any other list
        index = event.y + self.scroll_offset.y
        if not 0 <= index < self.row_count():
            return
        row, chosen = self.rows[index], index == self.cursor
        self.cursor = index
        on_mark = bool(row.count) and event.x < 2 * row.depth + 2
        if chosen or on_mark:
            self.post_message(self.Pressed(on_mark))

    def matches(self, index: int, query: Query) -> bool:
        """Whether a status matches a filter; parts that only contain others never do."""
        status = self.rows[index].status
        return status is not None and matches(status, query)

    def _name_width(self, width: int) -> int:
        if self._names[0] is not self.rows:
            longest = max((2 * each.depth + 4 + cell_len(sanitize(each.title)) for each in self.rows), default=0)
            self._names = (self.rows, longest)
        return max(12, min(self._names[1], MAX_NAME_CELLS, width - LEVEL_CELLS - AGE_CELLS - 2))

    def row(self, index: int, width: int) -> list[Segment]:
        """Fold mark, name, level, age, message."""
        row = self.rows[index]
        sign, style = LEVEL_STYLES[row.level]
        own = self.row_style(style)
        fold = ("▸ " if row.folded else "▾ ") if row.count else "  "
        name = cut(f"{'  ' * row.depth}{fold}{sanitize(row.title)}", self._name_width(width), pad=True)
        quiet = row.level is Level.OK
        return [
            Segment(name, self.row_style("head") if row.count else self.row_style("strong") if not quiet else None),
            Segment(f" {sign} {row.level.name:<{LEVEL_CELLS - 1}}", own),
            Segment(f"{age_text(row.age):>{AGE_CELLS}}  ", self.row_style("dim")),
            Segment(sanitize(self._last_message(row)), None if quiet else own),
        ]

    def _last_message(self, row: Row) -> str:
        below = f"{row.count - row.bad} of {row.count} OK" if row.count else ""
        return "  ".join(each for each in (row.message, below) if each)
