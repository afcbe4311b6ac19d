"""The range of a descriptor: the values that the node accepts, and those that steps and a slider offer. Pure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

TOLERANCE = 1e-6
"""Relative tolerance for the ends and steps of doubles, as rclpy's `Node.PARAM_REL_TOL`."""
STEPS_ACROSS = 100
"""Number of steps from end to end of a range that has no step of its own."""
MAX_SKIPPED_POINTS = 100
"""How many grid points may be skipped to find one that a double expresses exactly enough."""
NEGLIGIBLE = Fraction(1, 1000)
"""Fraction of a step within which a double counts as on a grid point, since doubles are calculated inexactly."""
MAX_DIGITS = 17
"""Significant digits that suffice to express every double."""


@dataclass(frozen=True, slots=True)
class Range:
    """A range that includes both ends. With a `step`, the values are the grid `low + n * step` and the upper end; 0
    means continuous. The ends of an integer's range are integers, since a float cannot hold large ones exactly.
    """

    low: float
    high: float
    step: float = 0.0

    @property
    def finite(self) -> bool:
        """Whether both ends are finite and differ, so that a slider can show the range."""
        return math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high

    def refusal(self, value: float) -> str:
        """Why rclpy refuses a value, in rclpy's words; empty if it accepts it."""
        low, high, step = self.low, self.high, self.step
        whole = isinstance(value, int)
        if value in (low, high) or (not whole and (_close(value, low) or _close(value, high))):
            return ""
        if not low < value < high:
            return f"out of range. Min: {low}, Max: {high}, value: {value}"
        on_step = (value - low) % step == 0 if whole and step else _on_step(value, low, step)
        return "" if on_step else f"not a valid step. Min: {low}, max: {high}, value: {value}, step: {step}"

    def share(self, value: float) -> float:
        """The position of a value in a finite range, from 0 to 1."""
        if not self.low < value < self.high:
            return 1.0 if value >= self.high else 0.0
        return float((Fraction(value) - Fraction(self.low)) / self._width)

    def at_share(self, share: float, *, whole: bool) -> float | None:
        """The accepted value nearest to a position (0 to 1) in the range; None if an end is not finite."""
        if not self.finite or share <= 0.0 or share >= 1.0:
            end = self.high if share >= 1.0 else self.low
            return end if math.isfinite(end) and self.low <= self.high else None
        exact = self._width * Fraction(share)
        if not whole and not self.step:
            return self._clamp(float(self.low + exact), self._hundredth_step)
        return self._point(round(exact / self._spacing), whole, upward=True)

    def moved(self, value: float, steps: int, *, whole: bool) -> float | None:
        """The accepted value a number of steps away, no further than the end; None if there is none."""
        if not (self.low <= value <= self.high and self.low < self.high):
            end = self.high if value > self.high else self.low
            return end if math.isfinite(end) and self.low <= self.high else None
        if not whole and not self.step:
            step = self._hundredth_step if self.finite else free_step(value)
            moved = self._clamp(value + steps * step, step)
            beside = math.nextafter(value, math.copysign(math.inf, steps))  # in a range that is only a few doubles wide
            return moved if moved != value else min(max(beside, self.low), self.high)
        if not (math.isfinite(self.low) and math.isfinite(min(abs(self.step), self.high))):
            return None
        place = (Fraction(value) - Fraction(self.low)) / self._spacing
        upward = steps > 0
        begin = math.floor(place) if upward else math.ceil(place)
        if not whole and abs(place - round(place)) < NEGLIGIBLE:
            begin = round(place)
        stride = max(1, self._width // STEPS_ACROSS) if whole and not self.step else 1
        return self._point(begin + steps * int(stride), whole, upward=upward)

    @property
    def _width(self) -> Fraction:
        return Fraction(self.high) - Fraction(self.low)

    @property
    def _spacing(self) -> Fraction:
        """The distance between two grid points; that of the ends if the node accepts nothing between them."""
        if self.step and not math.isfinite(self.step):
            return self._width
        return Fraction(abs(self.step) or 1)

    @property
    def _hundredth_step(self) -> float:
        return round_step(self.high / STEPS_ACROSS - self.low / STEPS_ACROSS)

    def _clamp(self, value: float, step: float) -> float:
        return min(max(rounded(value, step), self.low), self.high)

    def _point(self, at: int, whole: bool, *, upward: bool) -> float | None:
        """The value of a grid point, or of the next one that the node accepts; beyond the last one, the end."""
        ahead = 1 if upward else -1
        for each in range(at, at + ahead * MAX_SKIPPED_POINTS, ahead):
            exact = Fraction(self.low) + each * self._spacing
            if each <= 0:
                return self.low
            if exact > self.high - (0 if whole else self._spacing * NEGLIGIBLE):
                break
            for value in (int(exact),) if whole else _spellings(float(exact), self.low, each, self.step):
                if not self.refusal(value):
                    return value
        end = self.high if upward or at > 0 else self.low
        return end if math.isfinite(end) else None


def free_step(value: float) -> float:
    """The step for a number without a range: about a tenth of the number."""
    return round_step(max(abs(value) / 10, 0.1))


def round_step(step: float) -> float:
    """The nearest of 1, 2, 5 times a power of ten."""
    if not 0 < step < math.inf:
        return 0.1
    power = 10.0 ** math.floor(math.log10(step))
    return min((1, 2, 5, 10), key=lambda each: abs(each * power - step)) * power


def rounded(value: float, step: float) -> float:
    """A value without the digits far below a step, so that 0.1 + 0.2 is 0.3."""
    if not (math.isfinite(value) and value and step):
        return value
    places = math.floor(math.log10(abs(value))) - math.floor(math.log10(abs(step)))
    return float(f"{value:.{min(MAX_DIGITS, max(1, places + 7))}g}")


def _spellings(exact: float, low: float, at: int, step: float) -> Iterator[float]:
    """The value of a grid point as a person would write it, and as rclpy calculates it."""
    yield rounded(exact, step)
    yield exact
    yield low + at * step if at < 2**53 else exact


def _close(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=TOLERANCE)


def _on_step(value: float, low: float, step: float) -> bool:
    """Whether a double is close enough to a step by rclpy's calculation."""
    if not step:
        return True
    try:
        return _close(low + round((value - low) / step) * step, value)
    except (OverflowError, ValueError):  # rclpy raises it as well, for instance if the step is NaN
        return False
