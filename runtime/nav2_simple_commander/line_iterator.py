"""The points of a line at equal steps along its longer axis. Contract: upstream's module of this name."""

from __future__ import annotations

import math


class LineIterator:
    """Starts at the first end and is valid up to and including the last end, where it always stops."""

    def __init__(self, x0: float, y0: float, x1: float, y1: float, step_size: float = 1.0) -> None:
        """Raises `TypeError` for anything but numbers, `ValueError` for a non-positive step or zero length."""
        for name, value in (("x0", x0), ("y0", y0), ("x1", x1), ("y1", y1), ("step_size", step_size)):
            if type(value) not in (int, float):
                raise TypeError(f"{name} must be a number (int or float)")
        if step_size <= 0:
            raise ValueError("step_size must be a positive number")
        if (x0, y0) == (x1, y1):
            raise ValueError("Line has zero length (All 4 points have same coordinates)")
        self.x0_, self.y0_, self.x1_, self.y1_ = x0, y0, x1, y1
        self.x_, self.y_ = x0, y0
        self.step_size_ = step_size
        self._span = max(abs(x1 - x0), abs(y1 - y0))
        self._steps = 0
        self._valid = True

    def isValid(self) -> bool:
        """Return whether the current point is on the line."""
        return self._valid

    def advance(self) -> None:
        """Advance by one step, or past the last point."""
        if (self.x_, self.y_) == (self.x1_, self.y1_):
            self._valid = False
            return
        self._steps += 1
        gone = self._steps * self.step_size_
        if gone >= self._span:
            self.x_, self.y_ = self.x1_, self.y1_
            return
        share = gone / self._span
        self.x_ = self.x0_ + (self.x1_ - self.x0_) * share
        self.y_ = self.y0_ + (self.y1_ - self.y0_) * share

    def getX(self) -> float:
        """Return x of the current point."""
        return self.x_

    def getY(self) -> float:
        """Return y of the current point."""
        return self.y_

    def getX0(self) -> float:
        """Return x of the first end."""
        return self.x0_

    def getY0(self) -> float:
        """Return y of the first end."""
        return self.y0_

    def getX1(self) -> float:
        """Return x of the last end."""
        return self.x1_

    def getY1(self) -> float:
        """Return y of the last end."""
        return self.y1_

    def get_line_length(self) -> float:
        """Return the length, in the unit of the ends."""
        return math.sqrt((self.x1_ - self.x0_) ** 2 + (self.y1_ - self.y0_) ** 2)
