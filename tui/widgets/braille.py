"""A braille canvas: two by four dots in each cell, set by NumPy arrays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from bot_console.tui.widgets.picture import Piece

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
        """Set dots; those outside are ignored."""
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
        codes = np.zeros((self.height, self.width), np.uint8)
        for row in range(4):
            for column in range(2):
                codes |= self._dots[row::4, column::2] * BITS[row, column]
        return codes

    def rows(self) -> list[str]:
        """The picture as lines of text; empty cells are blanks, which cost one byte instead of three."""
        return characters(self.codes())


def characters(codes: npt.NDArray[np.uint8]) -> list[str]:
    """Codes of cells as lines of text, see `BrailleCanvas.rows`."""
    points = np.where(codes == 0, 0x20, 0x2800 + codes.astype(np.uint32)).astype("<u4")
    return [row.tobytes().decode("utf-32-le") for row in points]


def layered(
    layers: Sequence[npt.NDArray[np.uint8]], styles: Sequence[str], across: int, down: int
) -> list[list[Piece]]:
    """Combine the codes of several canvases; in a cell that they share, the first one determines the style.

    Blanks have the style of the run before them, since each change of style costs bytes.
    """
    if not layers:
        return [[(" " * across, "")] for _ in range(down)]
    codes = np.zeros_like(layers[0])
    owner = np.full(codes.shape, -1)
    for at in range(len(layers) - 1, -1, -1):
        owner[layers[at] > 0] = at
        codes |= layers[at]
    alone = owner.max(axis=1)
    mixed = ((owner >= 0) & (owner != alone[:, None])).any(axis=1)
    rows: list[list[Piece]] = []
    for row, text in enumerate(characters(codes)):
        if mixed[row]:
            rows.append(_pieces(text, owner[row].tolist(), styles))
        else:
            one = int(alone[row])
            rows.append([(text, styles[one] if one >= 0 else "")])
    return rows


def _pieces(text: str, owner: Sequence[int], styles: Sequence[str]) -> list[Piece]:
    pieces: list[Piece] = []
    begin, now = 0, -1
    for at, each in enumerate(owner):
        if each >= 0 and each != now:
            if now >= 0:
                pieces.append((text[begin:at], styles[now]))
                begin = at
            now = each
    pieces.append((text[begin:], styles[now] if now >= 0 else ""))
    return pieces
