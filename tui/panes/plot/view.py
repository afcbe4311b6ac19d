"""A plot as lines of text: frame, ticks and braille traces, or one strip per curve. Pure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from bot_console.tui.panes.plot.curves import ColumnRanges, Curve, column_ranges
from bot_console.tui.panes.plot.thresholds import first_crossed
from bot_console.tui.panes.plot.window_facts import window_facts
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.braille import BrailleCanvas, layered
from bot_console.tui.widgets.picture import Line

LABEL_CELLS = 9
"""Cells of the value axis with its labels."""

MIN_WIDE_CELLS = 130
"""Minimum width (cells) at which the legend has more statistics of each curve."""

HEAD_ROOM_SHARE = 0.05
"""Share of the value span kept free above the highest value, so that a curve at its limit is visible."""

MAX_VALUE = 1e300
"""Larger magnitudes are clipped to this, so that the difference of two values is always finite."""


@dataclass(frozen=True)
class Mark:
    """A parameter change or a refusal on the time axis (s), with its description."""

    time: float
    refused: bool = False
    text: str = ""


@dataclass(frozen=True)
class Axes:
    """The visible range: times in s, and the limits of the values if the user has set them."""

    start: float
    end: float
    limits: tuple[float, float] | None = None
    cursor: float | None = None
    """The time at the cursor; None without a cursor."""
    since: bool = False
    """Whether the labels count up from the left edge, instead of back from now."""

    def column(self, time: float, across: int) -> int | None:
        """The cell of a time in an axis of `across` cells; None if it is outside the window."""
        if not self.start <= time <= self.end:
            return None
        return min(across - 1, int((time - self.start) / (self.end - self.start) * across))

    def marks_at_cursor(self, marks: Sequence[Mark], across: int) -> list[Mark]:
        """The marks in the cell of the cursor."""
        at = None if self.cursor is None else self.column(self.cursor, across)
        return [] if at is None else [each for each in marks if self.column(each.time, across) == at]


def framed_plot(curves: Sequence[Curve], marks: Sequence[Mark], axes: Axes, width: int, height: int) -> list[Line]:
    """Draw all curves in one frame; `height` is at least 4 lines, two of them below the picture.

    Curves on the right axis have their own limits, labelled on the right; `axes.limits` applies to the left axis.
    """
    right = [each.right for each in curves]
    both = any(right) and not all(right)
    across, down = max(4, width - LABEL_CELLS * (2 if both else 1)), max(2, height - 2)
    ranges = [visible_ranges(curve, axes, across) for curve in curves]
    left_limits = axes.limits or limits(
        [each for each, other in zip(ranges, right, strict=True) if not (both and other)]
    )
    right_limits = limits([each for each, other in zip(ranges, right, strict=True) if other]) if both else left_limits
    spans = [right_limits if other else left_limits for other in right]
    layers = [trace_codes(each, *span, across, down) for each, span in zip(ranges, spans, strict=True)]
    watched = [(curve, span) for curve, span in zip(curves, spans, strict=True) if curve.thresholds]
    layers += [_dotted(curve, *span, across, down) for curve, span in watched]
    styles = [style_of(curve) for curve in (*curves, *(each for each, _ in watched))]
    rows = layered(layers, styles, across, down)
    labels, others = labels_of(*left_limits, down), labels_of(*right_limits, down) if both else {}
    lines: list[Line] = []
    for row, pieces in enumerate(rows):
        edge = "┤" if row in labels else "│"
        line: Line = ((f"{labels.get(row, ''):>{LABEL_CELLS - 2}} {edge}", "dim"), *pieces)
        if both:
            line = (*line, (f"{'├' if row in others else '│'} {others.get(row, ''):<{LABEL_CELLS - 2}}", "dim"))
        lines.append(line)
    return [*lines, *_time_axis(marks, axes, across, _excursions(curves, ranges))]


def _dotted(curve: Curve, low: float, high: float, across: int, down: int) -> npt.NDArray[np.uint8]:
    """The thresholds of a curve as dotted lines."""
    dots = BrailleCanvas(across, down)
    for each in curve.thresholds:
        if low <= each.value <= high:
            row = (high - each.value) / (high - low) * (down * 4 - 1)
            dots.points(np.arange(0, across * 2, 4), np.full(-(-across * 2 // 4), row))
    return dots.codes()


def _excursions(curves: Sequence[Curve], ranges: Sequence[ColumnRanges]) -> list[int]:
    """The cells in which a curve crosses one of its thresholds."""
    begins: set[int] = set()
    for curve, seen in zip(curves, ranges, strict=True):
        for each in curve.thresholds:
            with np.errstate(invalid="ignore"):
                beyond = seen.high > each.value if each.above else seen.low < each.value
            begins.update((np.flatnonzero(beyond & ~np.append(False, beyond[:-1])) // 2).tolist())
    return sorted(begins)


def strips(curves: Sequence[Curve], axes: Axes, width: int, height: int, chosen: int) -> list[Line]:
    """Draw a strip for each curve below its legend, dividing the lines among them."""
    lines: list[Line] = []
    room = max(2, height // max(1, len(curves)))
    for at, curve in enumerate(curves):
        seen = visible_ranges(curve, axes, width)
        low, high = axes.limits or limits([seen])
        lines.append(legend(curve, axes, width, at == chosen))
        rows = layered([trace_codes(seen, low, high, width, room - 1)], [style_of(curve)], width, room - 1)
        lines += [tuple(row) for row in rows]
    return lines[:height]


def style_of(curve: Curve) -> str:
    """The style of a curve's colour."""
    return f"curve-{curve.colour % 6}"


def visible_ranges(curve: Curve, axes: Axes, across: int) -> ColumnRanges:
    """The visible part of a curve, reduced to the columns of dots in `across` cells."""
    times, values = curve.between(axes.start, axes.end)
    return column_ranges(times, values.clip(-MAX_VALUE, MAX_VALUE), axes.start, axes.end, across * 2)


def limits_of_values(several: Sequence[npt.NDArray[np.float64]]) -> tuple[float, float]:
    """Limits of the value axis at round numbers that contain all of these values."""
    return limits(
        [ColumnRanges(each.clip(-MAX_VALUE, MAX_VALUE), each.clip(-MAX_VALUE, MAX_VALUE)) for each in several]
    )


def limits(ranges: Sequence[ColumnRanges]) -> tuple[float, float]:
    """Limits of the value axis at round numbers that contain all visible values, with headroom above the highest."""
    low = min((float(np.nanmin(each.low)) for each in ranges if np.isfinite(each.low).any()), default=0.0)
    high = max((float(np.nanmax(each.high)) for each in ranges if np.isfinite(each.high).any()), default=1.0)
    if high - low < 1e-12 * max(1.0, abs(high)):
        pad = abs(high) * 0.1 or 0.5
        low, high = low - pad, high + pad
        head_room = 0.0
    else:
        head_room = HEAD_ROOM_SHARE * (high - low)
    step = tick_step(high - low, 8)
    top = math.ceil(high / step) * step
    return math.floor(low / step) * step, top if top - high >= head_room else top + step / 2


def tick_step(span: float, maximum: int) -> float:
    """The smallest step of 1, 2 or 5 times a power of ten of which at most `maximum` fit into a span."""
    raw = span / max(1, maximum)
    if not (math.isfinite(raw) and raw > 0):
        return 1.0
    power = 10.0 ** math.floor(math.log10(raw))
    return next((each * power for each in (1, 2, 5) if each * power >= raw), 10 * power)


def trace_codes(seen: ColumnRanges, low: float, high: float, across: int, down: int) -> npt.NDArray[np.uint8]:
    """Braille codes of one trace, by row and column of cells."""
    canvas = BrailleCanvas(across, down)
    dots = down * 4
    scale = (dots - 1) / (high - low)
    with np.errstate(invalid="ignore"):
        top = np.round((high - seen.high) * scale)
        bottom = np.round((high - seen.low) * scale)
        # NaN compares false with everything, so its column stays empty.
        rows = np.arange(dots)[:, None]
        canvas.mask((rows >= top[None, :]) & (rows <= bottom[None, :]))
    return canvas.codes()


def labels_of(low: float, high: float, down: int) -> dict[int, str]:
    """The labels of the value axis, by row."""
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


def _time_axis(marks: Sequence[Mark], axes: Axes, across: int, beyond: Sequence[int]) -> list[Line]:
    """The axis with ticks and marks, `!` where a threshold is crossed, and labels: seconds before the right edge."""
    span = axes.end - axes.start
    step = tick_step(span, max(2, across // 12))
    axis = ["─"] * across
    labels = [" "] * (LABEL_CELLS + across)
    for count in range(math.floor(span / step + 1e-9) + 1):
        ago = span - count * step if axes.since else count * step
        column = min(across - 1, round((1 - ago / span) * (across - 1)))
        axis[column] = "┬"
        if axes.since:
            text = f"{short_number(span - ago, step)}s"
        else:
            text = "now" if ago == 0 else f"-{short_number(ago, step)}s"
        begin = min(LABEL_CELLS + column - len(text) // 2, LABEL_CELLS + across - len(text))
        if begin >= 0:
            labels[begin : begin + len(text)] = text
    for mark in marks:
        if (column := axes.column(mark.time, across)) is not None:
            axis[column] = "✗" if mark.refused else ("▲" if axis[column] != "✗" else "✗")
    for column in beyond:
        axis[column] = "!" if axis[column] in "─┬" else axis[column]
    edge = " " * (LABEL_CELLS - 1) + "╰"
    at = None if axes.cursor is None else axes.column(axes.cursor, across)
    if at is None:
        line: Line = ((edge + "".join(axis), "dim"),)
    else:
        line = ((edge + "".join(axis[:at]), "dim"), ("◆", "accent"), ("".join(axis[at + 1 :]), "dim"))
    return [line, (("".join(labels), "dim"),)]


def legend(curve: Curve, axes: Axes, width: int, chosen: bool) -> Line:
    """The name of a curve, its value at the cursor or else the newest one, and statistics of the visible samples."""
    start, style = ("▸ " if chosen else "  "), style_of(curve)
    facts = "  " + (sanitize(curve.problem) or (_facts(curve, axes, width) if width >= 60 else ""))
    if curve.latest is None and not curve.problem:
        facts = "  waiting for the first sample"
    room = max(8, width - len(start) - 2 - 9 - len(facts))
    path = sanitize(curve.path) + ("  right axis" if curve.right else "")
    name = path if len(path) <= room else "…" + path[-room + 1 :]
    over = first_crossed(curve.thresholds, _value(curve, axes))
    value = (f"{legend_value(curve, axes):>8} ", "error" if over else "strong")
    return ((start, "strong"), ("━ " + name.ljust(min(room, 48)), style), value, (facts, "dim"))


def _value(curve: Curve, axes: Axes) -> float | None:
    return curve.latest if axes.cursor is None else curve.at(axes.cursor)


def legend_value(curve: Curve, axes: Axes) -> str:
    """The value at the cursor or else the newest one; preceded by `!` if it is beyond a threshold."""
    value = _value(curve, axes)
    over = "!" if first_crossed(curve.thresholds, value) else ""
    return over + ("" if value is None else short_number(value))


def _facts(curve: Curve, axes: Axes, width: int) -> str:
    facts = window_facts(curve, axes.start, axes.end)
    if facts is None:
        return "no numbers in this window"
    text = f"min {short_number(facts.low)}  max {short_number(facts.high)}  mean {short_number(facts.mean)}"
    if width >= MIN_WIDE_CELLS:
        text += f"  σ {short_number(facts.std)}" + (f"  {short_number(facts.rate, 0.1)} Hz" if facts.rate else "")
    return text + (f"  {facts.gaps} not finite" if facts.gaps else "")
