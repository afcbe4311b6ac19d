"""A plot as lines of text: frame, ticks, braille traces, or one strip for each curve. Pure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from bot_console.tui.format import harmless
from bot_console.tui.panes.plot.curves import Curve, Reach, reach
from bot_console.tui.widgets.braille import BrailleCanvas, layered
from bot_console.tui.widgets.picture import Line

LABEL = 9
"""Cells of the value axis with its labels."""

HUGE = 1e300
"""Values beyond are drawn here, so that the difference of two values is always a number."""


@dataclass(frozen=True)
class Mark:
    """A parameter change (or a refusal) on the time axis (s), and what it was."""

    time: float
    refused: bool = False
    text: str = ""


@dataclass(frozen=True)
class Axes:
    """What is shown: times in s, and the limits of the values where a person gave them."""

    start: float
    end: float
    limits: tuple[float, float] | None = None
    cursor: float | None = None
    """The moment that is looked at."""
    since: bool = False
    """Whether times are told from the left edge on, instead of back from now."""

    def column(self, time: float, across: int) -> int | None:
        """The cell of a moment; None where it is not seen."""
        if not self.start <= time <= self.end:
            return None
        return min(across - 1, int((time - self.start) / (self.end - self.start) * across))

    def marks_at_cursor(self, marks: Sequence[Mark], across: int) -> list[Mark]:
        """The marks in the cell of the cursor."""
        at = None if self.cursor is None else self.column(self.cursor, across)
        return [] if at is None else [each for each in marks if self.column(each.time, across) == at]


def framed(curves: Sequence[Curve], marks: Sequence[Mark], axes: Axes, width: int, height: int) -> list[Line]:
    """All curves on common axes; `height` is at least 4 lines, two of them below the picture."""
    across, down = max(4, width - LABEL), max(2, height - 2)
    reaches = [_reach(curve, axes, across) for curve in curves]
    low, high = axes.limits or limits(reaches)
    layers = [_canvas(each, low, high, across, down) for each in reaches]
    rows = layered(layers, [_style(curve) for curve in curves], across, down)
    labels = _labels(low, high, down)
    lines: list[Line] = []
    for row, pieces in enumerate(rows):
        edge = "┤" if row in labels else "│"
        lines.append(((f"{labels.get(row, ''):>{LABEL - 2}} {edge}", "dim"), *pieces))
    return [*lines, *_time_axis(marks, axes, across)]


def strips(curves: Sequence[Curve], axes: Axes, width: int, height: int, chosen: int) -> list[Line]:
    """A strip for each curve below its name; the lines are shared out among them."""
    lines: list[Line] = []
    room = max(2, height // max(1, len(curves)))
    for at, curve in enumerate(curves):
        seen = _reach(curve, axes, width)
        low, high = axes.limits or limits([seen])
        lines.append(legend(curve, axes, width, at == chosen))
        rows = layered([_canvas(seen, low, high, width, room - 1)], [_style(curve)], width, room - 1)
        lines += [tuple(row) for row in rows]
    return lines[:height]


def _style(curve: Curve) -> str:
    return f"curve-{curve.colour % 6}"


def _reach(curve: Curve, axes: Axes, across: int) -> Reach:
    times, values = curve.between(axes.start, axes.end)
    return reach(times, values.clip(-HUGE, HUGE), axes.start, axes.end, across * 2)


def limits(reaches: Sequence[Reach]) -> tuple[float, float]:
    """Limits of the value axis that hold all that is seen, at round numbers."""
    low = min((float(np.nanmin(each.low)) for each in reaches if np.isfinite(each.low).any()), default=0.0)
    high = max((float(np.nanmax(each.high)) for each in reaches if np.isfinite(each.high).any()), default=1.0)
    if high - low < 1e-12 * max(1.0, abs(high)):
        pad = abs(high) * 0.1 or 0.5
        low, high = low - pad, high + pad
    step = tick_step(high - low, 8)
    return math.floor(low / step) * step, math.ceil(high / step) * step


def tick_step(span: float, most: int) -> float:
    """The smallest of 1, 2 and 5 times a power of ten of which at most so many fit into a span."""
    raw = span / max(1, most)
    if not (math.isfinite(raw) and raw > 0):
        return 1.0
    power = 10.0 ** math.floor(math.log10(raw))
    return next((each * power for each in (1, 2, 5) if each * power >= raw), 10 * power)


def _canvas(seen: Reach, low: float, high: float, across: int, down: int) -> npt.NDArray[np.uint8]:
    """Braille codes of one trace, by row and column of cells."""
    canvas = BrailleCanvas(across, down)
    dots = down * 4
    scale = (dots - 1) / (high - low)
    with np.errstate(invalid="ignore"):
        top = np.round((high - seen.high) * scale)
        bottom = np.round((high - seen.low) * scale)
        # A NaN compares false with everything, so its column stays empty.
        rows = np.arange(dots)[:, None]
        canvas.mask((rows >= top[None, :]) & (rows <= bottom[None, :]))
    return canvas.codes()


def _labels(low: float, high: float, down: int) -> dict[int, str]:
    """The text of each labelled row."""
    step = tick_step(high - low, max(2, down // 3))
    labels: dict[int, str] = {}
    for count in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-6) + 1):
        row = round((high - count * step) / (high - low) * (down * 4 - 1)) // 4
        labels[row] = short_number(count * step, step)
    return labels


def short_number(value: float, step: float = 0.0) -> str:
    """A number in at most 7 cells; `step` is the difference to its neighbours."""
    if not math.isfinite(value):
        return "nan" if math.isnan(value) else ("inf" if value > 0 else "-inf")
    if step and abs(value) < step / 1000:
        value = 0.0
    digits = 0 if step >= 1 else (min(5, -math.floor(math.log10(step) + 1e-9)) if step else 3)
    plain = abs(value) < 1e5 and not 0 < abs(value) < 1e-4
    forms = [f"{value:.{each}f}" for each in range(digits, -1, -1)] if plain else []
    forms += [f"{value:.1e}", f"{value:.0e}"]
    return next(form for form in forms if len(form) <= 7 or form is forms[-1])


def _time_axis(marks: Sequence[Mark], axes: Axes, across: int) -> list[Line]:
    """The axis with ticks and marks, and its labels: seconds before the right edge."""
    span = axes.end - axes.start
    step = tick_step(span, max(2, across // 12))
    axis = ["─"] * across
    labels = [" "] * (LABEL + across)
    for count in range(math.floor(span / step + 1e-9) + 1):
        ago = span - count * step if axes.since else count * step
        column = min(across - 1, round((1 - ago / span) * (across - 1)))
        axis[column] = "┬"
        if axes.since:
            text = f"{short_number(span - ago, step)}s"
        else:
            text = "now" if ago == 0 else f"-{short_number(ago, step)}s"
        begin = min(LABEL + column - len(text) // 2, LABEL + across - len(text))
        if begin >= 0:
            labels[begin : begin + len(text)] = text
    for mark in marks:
        if (column := axes.column(mark.time, across)) is not None:
            axis[column] = "✗" if mark.refused else ("▲" if axis[column] != "✗" else "✗")
    edge = " " * (LABEL - 1) + "╰"
    at = None if axes.cursor is None else axes.column(axes.cursor, across)
    if at is None:
        line: Line = ((edge + "".join(axis), "dim"),)
    else:
        line = ((edge + "".join(axis[:at]), "dim"), ("◆", "accent"), ("".join(axis[at + 1 :]), "dim"))
    return [line, (("".join(labels), "dim"),)]


def legend(curve: Curve, axes: Axes, width: int, chosen: bool) -> Line:
    """Name, newest value, and least, greatest and mean value of what is seen."""
    start, style = ("▸ " if chosen else "  "), _style(curve)
    latest = "" if curve.latest is None else short_number(curve.latest)
    facts = "  " + (harmless(curve.problem) or (_facts(curve, axes) if width >= 60 else ""))
    if curve.latest is None and not curve.problem:
        facts = "  waiting for the first sample"
    room = max(8, width - len(start) - 2 - 9 - len(facts))
    path = harmless(curve.path)
    name = path if len(path) <= room else "…" + path[-room + 1 :]
    return ((start, "strong"), ("━ " + name.ljust(min(room, 48)), style), (f"{latest:>8} ", "strong"), (facts, "dim"))


def _facts(curve: Curve, axes: Axes) -> str:
    times, values = curve.between(axes.start, axes.end)
    seen = values[(times >= axes.start) & (times <= axes.end)]
    fine = seen[np.isfinite(seen)]
    if not len(fine):
        return "no numbers in this window"
    lowest, highest, mean = (short_number(float(each)) for each in (fine.min(), fine.max(), fine.mean()))
    gaps = len(seen) - len(fine)
    return f"min {lowest}  max {highest}  mean {mean}" + (f"  {gaps} not finite" if gaps else "")
