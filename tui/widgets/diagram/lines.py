"""Lines on a grid of cells: which strokes meet in a cell, and the box-drawing character for them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from bot_console.tui.widgets.diagram.columns import Edge

UP, DOWN, LEFT, RIGHT = 1, 2, 4, 8

CHARACTERS = {
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
TURNS = tuple(sum(turned for stroke, turned in TURNED.items() if strokes & stroke) for strokes in range(16))
"""Strokes with rows and columns exchanged."""
BY_STROKES = tuple(CHARACTERS.get(strokes, " ") for strokes in range(16))
CROSSED = 16
"""Instead of strokes: lines of two items meet here."""
HEAD = 32
"""Instead of strokes: the head of an arrow."""
HEAD_BACK = 64
"""Instead of strokes: the head of an arrow that runs against the direction of the others."""

Cell = tuple[str, int, frozenset[Edge]]
"""Whose line it is, its strokes, and the edges it belongs to."""


class Lines:
    """Strokes by cell and by the item whose arrows they are; lines of one item join, those of two cross.

    Everything is given for arrows that run to the right; `downward` exchanges rows and columns. Cells of one line share
    one set of edges: a graph of some hundred nodes has a hundred thousand cells.
    """

    def __init__(self, downward: bool = False) -> None:
        self._downward = downward
        self._cells: dict[int, dict[int, Cell]] = {}
        self._lanes: dict[str, tuple[int, int, int]] = {}
        self._unions: dict[tuple[frozenset[Edge], frozenset[Edge]], frozenset[Edge]] = {}

    def _add(self, x: int, y: int, strokes: int, owner: str, edges: frozenset[Edge]) -> None:
        if self._downward:
            x, y = y, x
            strokes = TURNS[strokes] if strokes < CROSSED else strokes
        row = self._cells.get(y)
        if row is None:
            row = self._cells[y] = {}
        cell = row.get(x)
        if cell is None:
            row[x] = owner, strokes, edges
            return
        other, before, belongs = cell
        if before >= HEAD or strokes >= HEAD:
            strokes = max(before, strokes)
        elif other != owner or before == CROSSED:
            strokes = CROSSED
        else:
            strokes |= before
        row[x] = owner, strokes, edges if belongs is edges else self._union(belongs, edges)

    def _union(self, a: frozenset[Edge], b: frozenset[Edge]) -> frozenset[Edge]:
        key = (a, b)
        found = self._unions.get(key)
        if found is None:
            united = a | b  # one of the two if it contains all: equal sets should be one object
            found = self._unions[key] = next((each for each in key if len(each) == len(united)), united)
        return found

    def across(self, y: int, start: int, end: int, edges: frozenset[Edge], owner: str = "") -> None:
        """A horizontal line from `start` to `end`; it ends in the middle of a bend at either place.

        Without an `owner`, the line is that of the item at which the edges begin.
        """
        if not edges or start >= end:
            return
        owner = owner or next(iter(edges))[0]
        self._add(start, y, RIGHT, owner, edges)
        for x in range(start + 1, end):
            self._add(x, y, LEFT | RIGHT, owner, edges)
        self._add(end, y, LEFT, owner, edges)

    def down(self, x: int, start: int, end: int, edges: frozenset[Edge], owner: str = "") -> None:
        """A vertical line between two rows."""
        top, bottom = min(start, end), max(start, end)
        if not edges or top == bottom:
            return
        owner = owner or next(iter(edges))[0]
        self._add(x, top, DOWN, owner, edges)
        for y in range(top + 1, bottom):
            self._add(x, y, UP | DOWN, owner, edges)
        self._add(x, bottom, UP, owner, edges)

    def branches(self, x: int, origin: int, ends: Iterable[tuple[int, frozenset[Edge]]]) -> None:
        """Vertical lines of one item from one row to many: each piece belongs to the edges that continue beyond it."""
        above = sorted((each for each in ends if each[0] < origin), key=lambda each: each[0])
        below = sorted((each for each in ends if each[0] > origin), key=lambda each: -each[0])
        for side in (above, below):
            beyond = frozenset[Edge]()
            for at, (row, edges) in enumerate(side):
                beyond = self._union(beyond, edges)
                nearer = side[at + 1][0] if at + 1 < len(side) else origin
                self.down(x, row, nearer, beyond)

    def lane(self, owner: str, y: int, x: int, edges: frozenset[Edge]) -> None:
        """Extend the backward line of an item by one trunk, from those before it."""
        known = self._lanes.get(owner)
        if known is not None:
            self.across(y, min(known[1], x), max(known[1], x), edges)
        self._lanes[owner] = (y, x, x)

    def arrow(self, x: int, y: int, edges: frozenset[Edge]) -> None:
        """An arrow head."""
        if edges:
            self._add(x, y, HEAD, next(iter(edges))[0], edges)

    def stub(self, x: int, y: int, strokes: int, edges: frozenset[Edge], owner: str) -> None:
        """Half of a cell: where a line touches a box."""
        self._add(x, y, strokes, owner, edges)

    def arrow_back(self, x: int, y: int, edges: frozenset[Edge], owner: str) -> None:
        """An arrow head that points to the left."""
        self._add(x, y, HEAD_BACK, owner, edges)

    def erase(self, y: int, start: int, end: int) -> None:
        """Make room for a text from `start` to before `end`."""
        row = self._cells.get(y, {})
        for x in range(start, end):
            row.pop(x, None)

    def row(self, y: int) -> Iterator[tuple[int, str, frozenset[Edge]]]:
        """The segments of one row: the start, the text and the edges of each."""
        cells = self._cells.get(y)
        if not cells:
            return
        special = {CROSSED: CROSSING, HEAD: "▼" if self._downward else "▶", HEAD_BACK: "◀"}
        start, characters, belongs = 0, list[str](), frozenset[Edge]()
        for x in sorted(cells):
            _, strokes, edges = cells[x]
            if characters and (x != start + len(characters) or (edges is not belongs and edges != belongs)):
                yield start, "".join(characters), belongs
                characters = []
            if not characters:
                start, belongs = x, edges
            characters.append(BY_STROKES[strokes] if strokes < CROSSED else special[strokes])
        if characters:
            yield start, "".join(characters), belongs
