"""Curves plotted against another one instead of time: a robot's path, or a motor's response to a command."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bot_console.tui.panes.plot.curves import Array, Curve, as_steps
from bot_console.tui.panes.plot.formulas.formula import HeldValues, held_values
from bot_console.tui.panes.plot.view import (
    LABEL_CELLS,
    Axes,
    labels_of,
    limits_of_values,
    short_number,
    style_of,
    tick_step,
)
from bot_console.tui.widgets.braille import BrailleCanvas, layered
from bot_console.tui.widgets.picture import Line

MAX_DOTS = 200_000
"""Maximum number of dots of a trace, whatever its values."""


def pairs(across: Curve, curve: Curve, axes: Axes) -> tuple[Array, Array]:
    """The values of both curves at each sample of `curve` in the window; NaN in both where one of them has none."""
    times, values = curve.between(axes.start, axes.end)
    inside = (times >= axes.start) & (times <= axes.end)
    times, values = times[inside], values[inside]
    base_times, base = across.samples()
    if across.steps and len(base_times):
        base_times, base = as_steps(base_times, base, axes.end)
    x = held_values(HeldValues(base_times, np.where(np.isfinite(base), base, np.nan)), times)
    return np.where(np.isnan(values), np.nan, x), np.where(np.isnan(x), np.nan, values)


def draw_xy(across: Curve, curves: Sequence[Curve], axes: Axes, width: int, height: int) -> list[Line]:
    """Draw curves against the curve `across` in a frame with both value axes; ◆ marks the values at the cursor."""
    wide, down = max(4, width - LABEL_CELLS), max(2, height - 2)
    shown = [each for each in curves if each is not across]
    found = [pairs(across, each, axes) for each in shown]
    left, right = limits_of_values([x for x, _ in found])
    low, high = axes.limits or limits_of_values([y for _, y in found])
    scale = (wide * 2 - 1) / (right - left), (down * 4 - 1) / (high - low)
    layers = [_trace((x - left) * scale[0], (high - y) * scale[1], wide, down) for x, y in found]
    rows = layered(layers, [style_of(each) for each in shown], wide, down)
    labels = labels_of(low, high, down)
    lines: list[Line] = []
    for row, pieces in enumerate(rows):
        edge = "┤" if row in labels else "│"
        lines.append(((f"{labels.get(row, ''):>{LABEL_CELLS - 2}} {edge}", "dim"), *pieces))
    if axes.cursor is not None and (x := across.at(axes.cursor)) is not None:
        for each in shown:
            if (y := each.at(axes.cursor)) is not None and left <= x <= right and low <= y <= high:
                _put(lines, round((high - y) * scale[1]) // 4, LABEL_CELLS + round((x - left) * scale[0]) // 2)
    return [*lines, *_bottom(left, right, wide)]


def _trace(x: Array, y: Array, wide: int, down: int) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """The braille codes of straight lines from point to point; coordinates are in dots."""
    canvas = BrailleCanvas(wide, down)
    fine = np.isfinite(x) & np.isfinite(y)
    canvas.points(x[fine], y[fine])
    both = np.flatnonzero(fine[:-1] & fine[1:])
    steps = np.maximum(np.abs(x[both + 1] - x[both]), np.abs(y[both + 1] - y[both]))
    steps = np.minimum(np.ceil(steps), 2 * max(canvas.size)).astype(np.int64)
    if 0 < int(steps.sum()) <= MAX_DOTS:
        at = np.repeat(both, steps)
        part = (np.arange(len(at)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(steps, steps)
        canvas.points(x[at] + (x[at + 1] - x[at]) * part, y[at] + (y[at + 1] - y[at]) * part)
    return canvas.codes()


def _put(lines: list[Line], row: int, column: int) -> None:
    """Write the cursor's mark over a cell."""
    cells = [(character, style) for text, style in lines[row] for character in text]
    cells[column : column + 1] = [("◆", "accent")]
    lines[row] = tuple(cells)


def _bottom(left: float, right: float, wide: int) -> list[Line]:
    """The horizontal axis, with its labels."""
    step = tick_step(right - left, max(2, wide // 12))
    axis, labels = ["─"] * wide, [" "] * (LABEL_CELLS + wide)
    for count in range(int(np.ceil(left / step - 1e-9)), int(np.floor(right / step + 1e-6)) + 1):
        column = min(wide - 1, round((count * step - left) / (right - left) * (wide - 1)))
        axis[column] = "┬"
        text = short_number(count * step, step)
        begin = min(LABEL_CELLS + column - len(text) // 2, LABEL_CELLS + wide - len(text))
        labels[begin : begin + len(text)] = text
    return [((" " * (LABEL_CELLS - 1) + "╰" + "".join(axis), "dim"),), (("".join(labels), "dim"),)]
