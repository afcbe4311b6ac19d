"""A braille canvas: two by four dots in each cell, set by NumPy arrays."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

BITS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]], np.uint8)
"""The bit of each dot, by row and column in the cell (U+2800 and following)."""


class BrailleCanvas:
    """A picture of `width` by `height` cells; dots are counted from the upper left."""

    def __init__(self, width: int, height: int) -> None:
        self.width = width
        self.height = height
        self._dots = np.zeros((height * 4, width * 2), np.bool_)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in dots."""
        return self.width * 2, self.height * 4

    def points(self, x: npt.ArrayLike, y: npt.ArrayLike) -> None:
        """Set dots; those outside are left out."""
        column = np.round(np.asarray(x, float)).astype(np.int64)
        row = np.round(np.asarray(y, float)).astype(np.int64)
        inside = (column >= 0) & (column < self.width * 2) & (row >= 0) & (row < self.height * 4)
        self._dots[row[inside], column[inside]] = True

    def line(self, x0: float, y0: float, x1: float, y1: float) -> None:
        """Set the dots of a straight line."""
        count = int(max(abs(x1 - x0), abs(y1 - y0))) + 2
        if count > 100_000:
            return
        self.points(np.linspace(x0, x1, count), np.linspace(y0, y1, count))

    def mask(self, dots: npt.NDArray[np.bool_]) -> None:
        """Set the dots of a picture of the canvas's size."""
        self._dots |= dots

    def codes(self) -> npt.NDArray[np.uint8]:
        """The dots of each cell as bits, by row and column of cells."""
        cells = self._dots.reshape(self.height, 4, self.width, 2)
        return (cells * BITS[None, :, None, :]).sum(axis=(1, 3)).astype(np.uint8)

    def rows(self) -> list[str]:
        """The picture as lines of text; empty cells are blanks, which cost one byte and not three."""
        codes = self.codes().astype(np.uint32)
        letters = np.where(codes == 0, 0x20, 0x2800 + codes)
        return ["".join(map(chr, row)) for row in letters.tolist()]
