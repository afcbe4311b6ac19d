"""The layout of a plot for a file: positions of lines and texts, independent of the format (SVG, PNG)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from datetime import datetime

import numpy as np
from bot_console.tui.panes.plot.curves import ColumnRanges, Curve
from bot_console.tui.panes.plot.view import Axes, Mark, limits, short_number, tick_step, visible_ranges
from bot_console.tui.text.sanitize import sanitize

WIDTH_PX, HEIGHT_PX = 1000, 560
LEFT_PX, RIGHT_PX, TOP_PX, BOTTOM_PX = 70, 70, 20, 40
"""Margins of the frame; below it and its labels, the legend has a line for each curve."""
ROW_PX = 20
INK, GRID = "#1b1f27", "#d5d9e2"
COLOURS = ("#1f6feb", "#d9480f", "#2b8a3e", "#9c36b5", "#0b7285", "#a61e4d")


@dataclass(frozen=True)
class Words:
    """A text at a place; `anchor` is start, middle or end."""

    x: float
    y: float
    text: str
    anchor: str = "start"
    colour: str = INK


@dataclass(frozen=True)
class Stroke:
    """A line through points."""

    points: tuple[tuple[float, float], ...]
    colour: str
    width: float = 1.0
    dashed: bool = False


@dataclass
class VectorDrawing:
    """The elements of a drawing, in this order; sizes in pixels."""

    width: int = WIDTH_PX
    height: int = HEIGHT_PX
    strokes: list[Stroke] = field(default_factory=list[Stroke])
    words: list[Words] = field(default_factory=list[Words])


def plot_drawing(
    curves: Sequence[Curve], marks: Sequence[Mark], axes: Axes, wall: Callable[[float], float]
) -> VectorDrawing:
    """Lay out the visible plot; `wall` converts a time on the axis to wall-clock time (s since the epoch)."""
    page = VectorDrawing(height=HEIGHT_PX + ROW_PX * len(curves) + 12)
    right = [each.right for each in curves]
    both = any(right) and not all(right)
    seen = [visible_ranges(each, axes, (WIDTH_PX - LEFT_PX - RIGHT_PX) // 2) for each in curves]
    spans = [axes.limits or limits([each for each, other in zip(seen, right, strict=True) if not (both and other)])]
    spans.append(limits([each for each, other in zip(seen, right, strict=True) if other]) if both else spans[0])
    _values(page, spans[0], LEFT_PX - 6, "end", grid=True)
    if both:
        _values(page, spans[1], WIDTH_PX - RIGHT_PX + 6, "start", grid=False)
    _times(page, marks, axes, wall)
    for at, (curve, reach) in enumerate(zip(curves, seen, strict=True)):
        span, colour = spans[both and curve.right], COLOURS[curve.colour % len(COLOURS)]
        for each in curve.thresholds:
            if span[0] <= each.value <= span[1]:
                y = _y(each.value, span)
                page.strokes.append(Stroke(((LEFT_PX, y), (WIDTH_PX - RIGHT_PX, y)), colour, 1.0, dashed=True))
        page.strokes += [Stroke(points, colour, 1.6) for points in _traces(reach, span)]
        y = HEIGHT_PX + ROW_PX * at + 18
        page.strokes.append(Stroke(((LEFT_PX, y - 4), (LEFT_PX + 24, y - 4)), colour, 3.0))
        page.words.append(
            Words(LEFT_PX + 32, y, sanitize(curve.path) + (" (right axis)" if both and curve.right else ""))
        )
    return page


def _y(value: float, span: tuple[float, float]) -> float:
    return round(TOP_PX + (span[1] - value) / (span[1] - span[0]) * (HEIGHT_PX - TOP_PX - BOTTOM_PX), 2)


def _values(page: VectorDrawing, span: tuple[float, float], x: float, anchor: str, *, grid: bool) -> None:
    step = tick_step(span[1] - span[0], 10)
    for count in range(math.ceil(span[0] / step - 1e-9), math.floor(span[1] / step + 1e-6) + 1):
        y = _y(count * step, span)
        if grid:
            page.strokes.append(Stroke(((LEFT_PX, y), (WIDTH_PX - RIGHT_PX, y)), GRID))
        page.words.append(Words(x, y + 4, short_number(count * step, step), anchor))


def _times(page: VectorDrawing, marks: Sequence[Mark], axes: Axes, wall: Callable[[float], float]) -> None:
    span, bottom = axes.end - axes.start, HEIGHT_PX - BOTTOM_PX

    def place(time: float) -> float:
        return round(LEFT_PX + (time - axes.start) / span * (WIDTH_PX - LEFT_PX - RIGHT_PX), 2)

    step = tick_step(span, 8)
    first = wall(axes.start)
    for count in range(math.ceil(first / step), math.floor((first + span) / step) + 1):
        x = place(axes.start + count * step - first)
        page.strokes.append(Stroke(((x, TOP_PX), (x, bottom)), GRID))
        moment = datetime.fromtimestamp(count * step)
        text = f"{moment:%H:%M:%S}" + (f".{moment.microsecond // 1000:03}" if step < 1 else "")
        page.words.append(Words(x, bottom + 16, text, "middle"))
    for each in marks:
        if axes.start <= each.time <= axes.end:
            x = place(each.time)
            page.strokes.append(Stroke(((x, bottom), (x, bottom - 8)), "#c92a2a" if each.refused else INK, 2.0))
    corners = (
        (LEFT_PX, TOP_PX),
        (LEFT_PX, bottom),
        (WIDTH_PX - RIGHT_PX, bottom),
        (WIDTH_PX - RIGHT_PX, TOP_PX),
        (LEFT_PX, TOP_PX),
    )
    page.strokes.append(Stroke(tuple((float(x), float(y)) for x, y in corners), INK))
    page.words.append(Words(LEFT_PX, bottom + 34, f"{datetime.fromtimestamp(first):%Y-%m-%d %H:%M:%S}"))


def _traces(seen: ColumnRanges, span: tuple[float, float]) -> list[tuple[tuple[float, float], ...]]:
    """Polylines through the lowest and highest value of each column, interrupted where there is none."""
    fine = np.flatnonzero(np.isfinite(seen.low))
    runs = np.split(fine, np.flatnonzero(np.diff(fine) > 1) + 1) if len(fine) else []
    scale = (WIDTH_PX - LEFT_PX - RIGHT_PX) / len(seen.low)
    traces: list[tuple[tuple[float, float], ...]] = []
    for run in runs:
        points: list[tuple[float, float]] = []
        for column in run.tolist():
            x = round(LEFT_PX + (column + 0.5) * scale, 2)
            ends = [float(seen.low[column]), float(seen.high[column])]
            points += [(x, _y(min(max(each, span[0]), span[1]), span)) for each in dict.fromkeys(ends)]
        traces.append(tuple(points if len(points) > 1 else points * 2))
    return traces
