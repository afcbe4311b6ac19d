"""The cells that are occupied in a flow chart while its boxes are placed. Pure."""

from __future__ import annotations

from collections.abc import Iterable


class Cells:
    """The cells occupied by boxes and by horizontal and vertical lines, and the rows kept free to the right."""

    def __init__(self) -> None:
        self.boxes: set[tuple[int, int]] = set()
        self.across: set[tuple[int, int]] = set()
        self.down: set[tuple[int, int]] = set()
        self.kept: dict[int, int] = {}
        """The column from which each row is kept free for a backward line."""
        self.last: dict[int, int] = {}
        """The last occupied cell of each row."""

    def add(self, kind: set[tuple[int, int]], cells: Iterable[tuple[int, int]]) -> None:
        """Occupy cells of a kind."""
        for x, y in cells:
            kind.add((x, y))
            self.last[y] = max(self.last.get(y, -1), x)

    @property
    def bottom(self) -> int:
        """The first free row below everything."""
        return max(self.last, default=-1) + 1

    def free_for_box(self, x: int, end: int, rows: range) -> bool:
        """Whether a box has room in these rows, from column `x` to before column `end`."""
        for y in rows:
            if self.kept.get(y, end + 1) <= end:
                return False
            for at in range(x - 1, end + 1):
                cell = (at, y)
                if cell in self.boxes or (x <= at < end and (cell in self.across or cell in self.down)):
                    return False
        return True

    def free_across(self, y: int, start: int, end: int) -> bool:
        """Whether a horizontal line has room; it may cross vertical lines."""
        if self.kept.get(y, end) < end:
            return False
        return not any((x, y) in self.boxes or (x, y) in self.across for x in range(start, end))

    def free_down(self, x: int, rows: Iterable[int]) -> bool:
        """Whether a vertical line has room; it may cross horizontal lines."""
        return not any((x, y) in self.boxes or (x, y) in self.down for y in rows)

    def free_to_the_right(self, y: int, start: int) -> bool:
        """Whether a row can be kept free from a column on, for a backward line."""
        if y in self.kept:
            return False
        return not any((x, y) in self.boxes or (x, y) in self.across for x in range(start, self.last.get(y, -1) + 1))
