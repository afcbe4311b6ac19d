"""The drawing of the turtles, as pixels."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from bot_console_demos.turtlesim.motion import METRE, PIXELS

Color = tuple[int, int, int]
"""Red, green and blue, 0 to 255."""

BLANK: Color = (255, 255, 255)
"""The colour that a sensor reports where nothing has been drawn; it does not see the background."""


@dataclass(frozen=True)
class Pen:
    """A turtle's pen; `width` in pixels."""

    color: Color = (0xB3, 0xB8, 0xFF)
    width: int = 3
    down: bool = True


class Canvas:
    """A picture of `PIXELS` by `PIXELS`; positions are in m from the upper left corner, y downwards."""

    def __init__(self) -> None:
        self._pixels: npt.NDArray[np.uint8] = np.zeros((PIXELS, PIXELS, 4), np.uint8)
        self.changes = 0
        """The number of drawing and clearing operations."""
        self.clear()

    def clear(self) -> None:
        """Clear the drawing."""
        self._pixels[:] = (*BLANK, 0)
        self.changes += 1

    def line(self, start: tuple[float, float], end: tuple[float, float], pen: Pen) -> None:
        """Draw a straight line."""
        ends = np.array([start, end]) * METRE
        if not np.isfinite(ends).all():
            return
        length = float(np.abs(ends[1] - ends[0]).max())
        count = min(max(math.ceil(length), 1), 2 * PIXELS)
        shares: npt.NDArray[np.float64] = np.arange(count + 1) / count
        points = ends[0] + shares[:, None] * (ends[1] - ends[0])
        reach = np.arange(pen.width) - (pen.width - 1) // 2
        columns = np.rint(points[:, 0]).astype(np.int64)[:, None, None] + reach[None, :, None]
        rows = np.rint(points[:, 1]).astype(np.int64)[:, None, None] + reach[None, None, :]
        inside = (columns >= 0) & (columns < PIXELS) & (rows >= 0) & (rows < PIXELS)
        columns, rows = np.broadcast_arrays(columns, rows)
        self._pixels[rows[inside], columns[inside]] = (*pen.color, 255)
        self.changes += 1

    def color(self, place: tuple[float, float]) -> Color:
        """Return the colour at a position inside the field."""
        column, row = (round(each * METRE) for each in place)
        red, green, blue, _ = self._pixels[row, column].tolist()
        return red, green, blue

    def picture(self, background: Color) -> npt.NDArray[np.uint8]:
        """Return rows of red, green, blue and drawn (255 or 0), over a background."""
        picture: npt.NDArray[np.uint8] = np.array(self._pixels)
        picture[picture[:, :, 3] == 0] = (*background, 0)
        return picture
