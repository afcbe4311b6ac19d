"""Lines on a grid of cells: which strokes meet in a cell, and the box-drawing letter for them."""

from __future__ import annotations

from collections.abc import Iterator

from bot_console.tui.widgets.diagram.layering import Edge

UP, DOWN, LEFT, RIGHT = 1, 2, 4, 8

LETTERS = {
    UP | DOWN: "│",
    LEFT | RIGHT: "─",
    UP | RIGHT: "╰",
    UP | LEFT: "╯",
    DOWN | RIGHT: "╭",
    DOWN | LEFT: "╮",
    UP | DOWN | RIGHT: "├",
    UP | DOWN | LEFT: "┤",
    LEFT | RIGHT | UP: "┴",
    LEFT | RIGHT | DOWN: "┬",
    UP | DOWN | LEFT | RIGHT: "╋",
    UP: "│",
    DOWN: "│",
    LEFT: "─",
    RIGHT: "─",
}
CROSSING = "┼"
TURNED = {UP: LEFT, DOWN: RIGHT, LEFT: UP, RIGHT: DOWN}


class Lines:
    """Strokes by cell and by the item whose arrows they are; lines of one item join, those of two cross.

    Everything is given for arrows that run to the right; `downward` exchanges rows and columns.
    """

    def __init__(self, downward: bool = False) -> None:
        self._downward = downward
        self._strokes: dict[int, dict[int, dict[str, int]]] = {}
        self._edges: dict[tuple[int, int], set[Edge]] = {}
        self._arrows: set[tuple[int, int]] = set()
        self._lanes: dict[str, tuple[int, int, int]] = {}

    def _add(self, x: int, y: int, strokes: int, edges: frozenset[Edge]) -> None:
        if not edges or not strokes:
            return
        if self._downward:
            x, y = y, x
            strokes = sum(turned for stroke, turned in TURNED.items() if strokes & stroke)
        owner = next(iter(edges))[0]
        cell = self._strokes.setdefault(y, {}).setdefault(x, {})
        cell[owner] = cell.get(owner, 0) | strokes
        self._edges.setdefault((x, y), set()).update(edges)

    def across(self, y: int, start: int, end: int, edges: frozenset[Edge]) -> None:
        """A horizontal line from `start` to `end`; it ends in the middle of a bend at either place."""
        for x in range(start, end + 1):
            left, right = LEFT if x > start else 0, RIGHT if x < end else 0
            self._add(x, y, left | right, edges)

    def down(self, x: int, start: int, end: int, edges: frozenset[Edge]) -> None:
        """A vertical line between two rows."""
        top, bottom = min(start, end), max(start, end)
        for y in range(top, bottom + 1):
            self._add(x, y, (UP if y > top else 0) | (DOWN if y < bottom else 0), edges)

    def lane(self, owner: str, y: int, x: int, edges: frozenset[Edge]) -> None:
        """One more trunk on the way back of an item: draw the line from those before it to this one."""
        known = self._lanes.get(owner)
        if known is not None:
            self.across(y, min(known[1], x), max(known[1], x), edges)
        self._lanes[owner] = (y, x, x)

    def arrow(self, x: int, y: int, edges: frozenset[Edge]) -> None:
        """The head of an arrow."""
        self._arrows.add((y, x) if self._downward else (x, y))
        self._add(x, y, LEFT, edges)

    def row(self, y: int) -> Iterator[tuple[int, str, frozenset[Edge]]]:
        """The pieces of one row: where each starts, its text, and the edges it belongs to."""
        start, text, belongs = 0, "", frozenset[Edge]()
        for x in sorted(self._strokes.get(y, ())):
            edges = frozenset(self._edges[x, y])
            if text and (x != start + len(text) or edges != belongs):
                yield start, text, belongs
                text = ""
            if not text:
                start, belongs = x, edges
            text += self._letter(x, y)
        if text:
            yield start, text, belongs

    def _letter(self, x: int, y: int) -> str:
        if (x, y) in self._arrows:
            return "▼" if self._downward else "▶"
        owners = self._strokes[y][x]
        if len(owners) > 1:
            return CROSSING
        return LETTERS[next(iter(owners.values()))]
