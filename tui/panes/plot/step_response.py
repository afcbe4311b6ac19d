"""Step responses: a curve after the values of a set were sent, and its figures. Pure."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from bot_console.tui.console.model import Change
from bot_console.tui.panes.plot.curves import Array
from bot_console.tui.text.expression.numbers import evaluate

SETS = ("set A", "set B")
"""The names of the two sets of changes whose responses are compared."""
SETTLED_SHARE = 0.05
"""The response has settled once it stays within this share of its step."""
RISE_SHARES = (0.1, 0.9)
END_SHARE = 0.2
"""The last part of a response, whose mean is taken as its final value."""
FIGURES = ("rise", "overshoot", "settling", "error")


@dataclass(frozen=True)
class Response:
    """A curve after a change; times are in s since the change."""

    name: str
    times: Array
    values: Array
    before: float
    """The value before the change."""


@dataclass(frozen=True)
class Figures:
    """Rise time (s, 10 to 90 %), overshoot (share of the step), settling time (s, 5 %) and steady error.

    NaN if there is no step, or the response has not got that far yet.
    """

    rise: float = math.nan
    overshoot: float = math.nan
    settling: float = math.nan
    error: float = math.nan


def moments(changes: Sequence[Change]) -> dict[str, int]:
    """When each set was last sent (ns since the epoch), without sets that never were."""
    found: dict[str, int] = {}
    for each in reversed(changes):
        if each.accepted and each.by in SETS and each.by not in found:
            found[each.by] = each.stamp
        if len(found) == len(SETS):
            break
    return found


def response(name: str, times: Array, values: Array, start: float, end: float) -> Response | None:
    """The part of a curve from `start` to `end` (s); None if it has no sample there."""
    inside = (times >= start) & (times <= end) & np.isfinite(values)
    if not inside.any():
        return None
    earlier = values[(times < start) & np.isfinite(values)]
    shown = values[inside]
    return Response(name, times[inside] - start, shown, float(earlier[-1] if len(earlier) else shown[0]))


def figures(response: Response, reference: float | None = None) -> Figures:
    """The figures of a step response; the steady error is the reference minus the final value."""
    times, values = response.times, response.values
    final = float(np.mean(values[times >= times[-1] * (1 - END_SHARE)]))
    error = math.nan if reference is None else reference - final
    step = final - response.before
    if abs(step) <= 1e-9 * max(1.0, abs(final)):
        return Figures(error=error)
    done = (values - response.before) / step
    overshoot = max(0.0, float(done.max()) - 1.0)
    reached = [_first(times, done >= share) for share in RISE_SHARES]
    rise = reached[1] - reached[0]
    outside = np.flatnonzero(np.abs(done - 1.0) > SETTLED_SHARE)
    settled = int(outside[-1]) + 1 if len(outside) else 0
    settling = float(times[settled]) if settled < len(times) else math.nan
    return Figures(rise, overshoot, settling, error)


def _first(times: Array, where: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> float:
    return float(times[int(np.argmax(where))]) if where.any() else math.nan


def score(formula: str, of: Figures) -> float:
    """Evaluate the user's formula on the figures; raises `ValueError` that says what is wrong with it."""
    names: Mapping[str, float] = {name: getattr(of, name) for name in FIGURES}
    return float(evaluate(formula, names))


def figures_text(of: Figures, formula: str = "") -> str:
    """The figures on one line, with the score if there is a formula."""

    def show(value: float, unit: str, digits: int = 2) -> str:
        return "–" if math.isnan(value) else f"{value:.{digits}f}{unit}"

    parts = [f"rise {show(of.rise, ' s')}", f"overshoot {show(of.overshoot * 100, ' %', 0)}"]
    parts += [f"settling {show(of.settling, ' s')}", f"error {show(of.error, '')}"]
    if formula:
        try:
            parts.append(f"score {show(score(formula, of), '', 3)}")
        except ValueError as error:
            parts.append(str(error))
    return "  ".join(parts)
