"""The rows of the list of frames: the tree, and how often, when and by whom each frame is published."""

from __future__ import annotations

from bot_console.tui.panes.graph.frame_tree import FrameRow
from bot_console.tui.text.figures import age_text
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment

RATE_CELLS, AGE_CELLS = 9, 7
MAX_NAME_CELLS = 44
"""Maximum cells of a name."""


class FrameRows(ItemList[FrameRow]):
    """One frame per row."""

    def key(self, item: FrameRow) -> object:
        """The frame's name: its place in the tree may change."""
        return item.name

    def row(self, index: int, width: int) -> list[Segment]:
        """Tree and name, rate, age, publisher, and problems."""
        row = self.rows[index]
        longest = max(2 * each.depth + cell_len(sanitize(each.name)) for each in self.rows)
        name = cut(
            "  " * row.depth + sanitize(row.name),
            max(12, min(longest, MAX_NAME_CELLS, width - RATE_CELLS - AGE_CELLS)),
            pad=True,
        )
        trouble = [Segment(f"✗ {sanitize(row.trouble)}  ", self.row_style("error"))] if row.trouble else []
        return [
            Segment(name, self.row_style("head") if row.frame is None else None),
            Segment(f"{_rate(row):>{RATE_CELLS}}"),
            Segment(f"{age_text(row.age):>{AGE_CELLS}}  ", self.row_style("dim")),
            *trouble,
            Segment(sanitize(row.by), self.row_style("dim")),
        ]


def _rate(row: FrameRow) -> str:
    if row.frame is None:
        return ""
    if row.frame.fixed:
        return "fixed"
    return "" if row.frame.rate is None else f"{row.frame.rate:.1f} Hz"
