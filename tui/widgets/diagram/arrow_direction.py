"""The direction of the arrows, and the sizes that depend on it. Pure.

The layout works in two directions: along the arrows and across them. `ArrowDirection` tells how many cells things take
in each.
"""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.widgets.diagram.graph import Item
from rich.cells import cell_len


@dataclass(frozen=True)
class ArrowDirection:
    """A direction of arrows, with suitable distances in cells."""

    downward: bool
    track: int
    """From one line to the next in a channel."""
    port: int
    """From one arrow head to the next at an item."""
    gap: int
    """Between two items of a column, across the arrows."""
    lane: int
    """From one backward line to the next."""
    shortest: int
    """The minimum length of a straight arrow."""

    def along(self, item: Item) -> int:
        """The size of an item in cells in the direction of the arrows."""
        return (3 if item.boxed else 1) if self.downward else self._label(item)

    def across(self, item: Item, arrows_in: int) -> int:
        """The size of an item in cells across the arrows; each incoming arrow has its own port."""
        ports = max(1, arrows_in)
        if self.downward:
            return max(self._label(item), self.port * (ports - 1) + 1 + (4 if item.boxed else 2))
        return ports + (2 if item.boxed else 0)

    def first_port(self, top: int, size: int, arrows_in: int) -> int:
        """The position at which the first arrow into an item ends."""
        return top + (size - (self.port * (arrows_in - 1) + 1)) // 2

    def room(self, tracks: int) -> int:
        """The width in cells of a channel with a number of tracks."""
        return max(self.shortest, 2 + self.track * tracks)

    @staticmethod
    def _label(item: Item) -> int:
        return cell_len(item.label) + (4 if item.boxed else 2)


RIGHT = ArrowDirection(downward=False, track=2, port=1, gap=1, lane=1, shortest=3)
DOWN = ArrowDirection(downward=True, track=1, port=2, gap=2, lane=2, shortest=2)
