"""One line per curve: name, value, rate, minimum, maximum, and a small trace; for many curves."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.view import (
    Axes,
    legend_value,
    limits,
    short_number,
    style_of,
    trace_codes,
    visible_ranges,
)
from bot_console.tui.panes.plot.window_facts import WindowFacts, window_facts
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.braille import layered
from bot_console.tui.widgets.picture import Line

FIGURE_CELLS = 9
"""Cells of each figure."""
MIN_TRACE_COLUMNS = 12


def sparklines(curves: Sequence[Curve], axes: Axes, width: int, height: int, chosen: int) -> list[Line]:
    """A heading, and a line for each curve for which there is room, always including the chosen one."""
    columns = ["value", "rate", "min", "max"]
    while len(columns) > 1 and width < 24 + FIGURE_CELLS * len(columns) + MIN_TRACE_COLUMNS:
        columns.pop()
    name = max(
        12, min(48, max(len(each.path) for each in curves) + 3, width - FIGURE_CELLS * len(columns) - MIN_TRACE_COLUMNS)
    )
    across = max(4, width - name - FIGURE_CELLS * len(columns) - 1)
    heading = " " * name + "".join(f"{each:>{FIGURE_CELLS}}" for each in columns)
    rows = max(1, height - 1)
    first = max(0, min(chosen - rows // 2, len(curves) - rows))
    lines: list[Line] = [((heading, "dim"),)]
    for at, curve in enumerate(curves[first : first + rows], first):
        facts = window_facts(curve, axes.start, axes.end)
        figures = _figures(curve, facts, axes)
        seen = visible_ranges(curve, axes, across)
        trace = layered([trace_codes(seen, *limits([seen]), across, 1)], [style_of(curve)], across, 1)[0]
        mark = "▸ " if at == chosen else "  "
        text = "".join(f"{figures[each]:>{FIGURE_CELLS}}" for each in columns)
        lines.append(((mark, "strong"), (cut(sanitize(curve.path), name - 3, pad=True) + " ", style_of(curve)),
                      (text, "strong" if at == chosen else ""), (" ", ""), *trace))  # fmt: skip
    return lines


def _figures(curve: Curve, facts: WindowFacts | None, axes: Axes) -> dict[str, str]:
    value = legend_value(curve, axes)
    if facts is None:
        return {"value": value, "rate": "", "min": "", "max": ""}
    rate = f"{short_number(facts.rate, 0.1)}/s" if facts.rate else ""
    return {"value": value, "rate": rate, "min": short_number(facts.low), "max": short_number(facts.high)}
