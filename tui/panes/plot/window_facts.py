"""Statistics of a curve's samples within a time window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from bot_console.tui.panes.plot.curves import Curve


@dataclass(frozen=True)
class WindowFacts:
    """Minimum, maximum and mean, standard deviation, samples per second, and the number of non-finite samples."""

    low: float
    high: float
    mean: float
    std: float
    rate: float
    gaps: int


def window_facts(curve: Curve, start: float, end: float) -> WindowFacts | None:
    """The statistics of a window (s); None if it contains no finite value."""
    times, values = curve.between(start, end)
    inside = (times >= start) & (times <= end)
    seen, moments = values[inside], times[inside]
    fine = seen[np.isfinite(seen)]
    if not len(fine):
        return None
    span = float(moments[-1] - moments[0])
    rate = (len(moments) - 1) / span if span > 0 and not curve.steps else 0.0
    with np.errstate(over="ignore", invalid="ignore"):
        low, high, mean, std = (float(each) for each in (fine.min(), fine.max(), fine.mean(), fine.std()))
    return WindowFacts(low, high, mean, std, rate, len(seen) - len(fine))
