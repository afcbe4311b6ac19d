"""A curve computed from others by an expression."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from bot_console.tui.console.plot.port import Plots
from bot_console.tui.panes.plot.curves import Array, Curve, as_steps
from bot_console.tui.panes.plot.formulas.formula import Formula, HeldValues


class ComputedCurve(Curve):
    """An expression over curves. It stores no samples: its values are computed from theirs when they are needed."""

    def __init__(self, formula: Formula, colour: int, parts: Mapping[str, Curve]) -> None:
        super().__init__(formula.text, colour)
        self._formula = formula
        self._parts = parts

    @property
    def steps(self) -> bool:
        """Whether the expression contains parameters only."""
        return not self._formula.lead

    @property
    def latest(self) -> float | None:
        """The newest value."""
        end = self.end
        return None if end is None else self.at(end)

    @property
    def end(self) -> float | None:
        """The time of the newest sample."""
        leads = [self._formula.lead] if self._formula.lead else self._formula.paths
        ends = [end for each in leads if (end := self._parts[each].end) is not None]
        return max(ends, default=None)

    def fetch_samples(self, plots: Plots) -> bool:
        """Fetch nothing, as the parts are fetched separately; returns whether they have changed."""
        cursor = sum(each.cursor for each in self._parts.values())
        problem = next((each.problem for each in self._parts.values() if each.problem), "")
        changed = (cursor, problem) != (self.cursor, self.problem)
        self.cursor, self.problem = cursor, problem
        return changed

    def samples(self) -> tuple[Array, Array]:
        """All times and values."""
        return self._formula.values(self._known())

    def at(self, time: float) -> float | None:
        """The value that was the newest one at a time; None before the first."""
        times, values = self._formula.values(self._known(), time, time)
        place = int(np.searchsorted(times, time, side="right")) - 1
        return float(values[place]) if place >= 0 else None

    def clear(self) -> None:
        """Do nothing: no samples are stored here."""

    def between(self, start: float, end: float) -> tuple[Array, Array]:
        """The polyline from `start` to `end` (s)."""
        times, values = self._formula.values(self._known(), start, end)
        values = np.where(np.isfinite(values), values, np.nan)
        return as_steps(times, values, end) if self.steps and len(times) else (times, values)

    def _known(self) -> Mapping[str, HeldValues]:
        return {path: HeldValues(*each.samples(), each.steps) for path, each in self._parts.items()}
