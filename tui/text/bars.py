"""Numbers as bars of one cell. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

BARS = "▁▂▃▄▅▆▇█"
MAX_DRAWN = 1e300
"""Numbers from this size on, infinite ones and NaN have no bar."""


def bars(values: Sequence[object]) -> list[str]:
    """A bar for each number, on a scale from zero to the greatest of them; blanks if anything is not a number."""
    numbers = [each for each in values if isinstance(each, (int, float)) and not isinstance(each, bool)]
    if len(numbers) < len(values):
        return [" "] * len(values)
    finite = [each for each in numbers if abs(each) < MAX_DRAWN]
    low, high = min(0, 0, *finite), max(0, 0, *finite)
    steps = len(BARS) - 1
    return [
        BARS[round((each - low) / ((high - low) or 1) * steps)] if abs(each) < MAX_DRAWN else " " for each in numbers
    ]


def strip(values: Iterable[float], top: float) -> str:
    """A bar for each number on a scale from zero to `top`; greater ones are as high as `top`."""
    steps = len(BARS) - 1
    return "".join(BARS[round(min(max(each, 0.0), top) / (top or 1) * steps)] for each in values)
