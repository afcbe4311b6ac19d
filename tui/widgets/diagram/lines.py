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
"""Marks a cell, instead of strokes, in which lines of two items cross."""
HEAD = 32
"""Marks a cell, instead of strokes, with an arrow head."""
HEAD_BACK = 64
"""Marks a cell, instead of strokes, with the head of an arrow that runs against the direction of the others."""

Cell = tuple[str, int, frozenset[Edge]]
"""The owner of a line in a cell, the strokes, and the edges they belong to."""


class Lines:
    """The strokes in each cell; lines of the same owner join, lines of different owners cross.

    All coordinates are for arrows that run to the right; `downward` swaps rows and columns. The cells of a line share
    one set of edges, as a graph of a few hundred nodes has a hundred thousand cells.
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
            united = a | b  # use `a` or `b` itself if it is equal, so that equal sets are one object
            found = self._unions[key] = next((each for each in key if len(each) == len(united)), united)
        return found

    def across(self, y: int, start: int, end: int, edges: frozenset[Edge], owner: str = "") -> None:
        """Draw a horizontal line from `start` to `end`, with half a stroke in either cell so that bends can join it.

        Without an `owner`, the line belongs to the item at which the edges begin.
        """
        if not edges or start >= end:
            return
        owner = owner or next(iter(edges))[0]
        self._add(start, y, RIGHT, owner, edges)
        for x in range(start + 1, end):
            self._add(x, y, LEFT | RIGHT, owner, edges)
        self._add(end, y, LEFT, owner, edges)

    def down(self, x: int, start: int, end: int, edges: frozenset[Edge], owner: str = "") -> None:
        """Draw a vertical line between two rows."""
        top, bottom = min(start, end), max(start, end)
        if not edges or top == bottom:
            return
        owner = owner or next(iter(edges))[0]
        self._add(x, top, DOWN, owner, edges)
        for y in range(top + 1, bottom):
            self._add(x, y, UP | DOWN, owner, edges)
        self._add(x, bottom, UP, owner, edges)

    def branches(self, x: int, origin: int, ends: Iterable[tuple[int, frozenset[Edge]]]) -> None:
        """Draw vertical lines from one row to several; each piece belongs to the edges that continue beyond it."""
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
        """Draw an arrow head."""
        if edges:
            self._add(x, y, HEAD, next(iter(edges))[0], edges)

    def stub(self, x: int, y: int, strokes: int, edges: frozenset[Edge], owner: str) -> None:
        """Draw half a stroke in a cell, where a line touches a box."""
        self._add(x, y, strokes, owner, edges)

    def arrow_back(self, x: int, y: int, edges: frozenset[Edge], owner: str) -> None:
        """Draw an arrow head that points to the left."""
        self._add(x, y, HEAD_BACK, owner, edges)

    def erase(self, y: int, start: int, end: int) -> None:
        """Erase the cells from `start` to before `end`, to make room for a text."""
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
