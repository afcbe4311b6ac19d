"""The column widths of the parameter pane: names get room before values, and values before descriptions.

A few names that are much longer than the others overflow their column, rather than cost every row its slider.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from bot_console.tui.console.model import Value
from bot_console.tui.console.parameters.described_unit import unit_in_description
from bot_console.tui.panes.parameters.rows import Row
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text
from rich.cells import cell_len

BAR_CELLS, MIN_BAR_CELLS = 12, 6
"""Maximum and minimum cells of a slider."""

FEW = 10
"""One name in this many may be longer than its column, if that leaves room for the sliders."""

MARKS_CELLS = 2
"""Cells of the marks before a name."""
GAP_CELLS, END_CELLS = 2, 1
"""Cells between columns, and after a slider."""

MIN_VALUE_CELLS = 8
"""Minimum cells of a value."""

MIN_NAME = 8
"""Minimum cells of the name column, wherever the user moves its edge."""

MIN_DESCRIPTION_CELLS = 20
"""Minimum cells of a description; if there is less room, it is left out."""


@dataclass(frozen=True)
class Measures:
    """The cells that the rows need: for the longest name with its indentation, and for the longest number with a
    slider.
    """

    name: int = 0
    number: int = MIN_VALUE_CELLS
    max_names: int = 0
    """The longest name apart from the few that may overflow; 0 if there are no names."""


@dataclass(frozen=True)
class Columns:
    """Cells of each column after the marks; 0 if the column is left out."""

    name: int
    value: int
    bar: int
    description: int


def measure(rows: Sequence[Row]) -> Measures:
    """Measure the rows; numbers are rounded up to two cells, so that the columns rarely move when a value changes."""
    names: list[int] = []
    number = MIN_VALUE_CELLS
    for row in rows:
        if row.parameter is None:
            continue
        names.append(name_cells(row))
        if row.parameter.range is not None:
            number = max(number, _number_cells(row.parameter.value, row.parameter.description))
    names.sort()
    few = len(names) // FEW
    return Measures(max(names, default=0), -(-number // 2) * 2, names[-1 - few] if names else 0)


def name_cells(row: Row) -> int:
    """Cells of a parameter's name with its indentation."""
    return 2 * row.depth + _cells(row.name)


@lru_cache(maxsize=20_000)
def _cells(name: str) -> int:
    return cell_len(sanitize(name))


@lru_cache(maxsize=20_000, typed=True)
def _number_cells(value: Value, description: str) -> int:
    """Cells of a value and its unit; cached, as each key typed into a filter measures thousands of mostly old ones."""
    unit = unit_in_description(description)
    return cell_len(value_text(value)) + (cell_len(unit) + 1 if unit else 0)


def shown_value(row: Row) -> str:
    """The value of a parameter with its unit."""
    parameter = row.parameter
    if parameter is None:
        return ""
    return sanitize(value_text(parameter.value)) + (f" {parameter.unit}" if parameter.unit else "")


def name_column(row: Row, own: Columns, width: int, split: int = 0) -> int:
    """Cells of a row's name: the column, or more for one of the few names that overflow it.

    If the user has set the width of the column, no name overflows it.
    """
    return own.name if split else max(own.name, min(name_cells(row), width - MARKS_CELLS - GAP_CELLS - MIN_VALUE_CELLS))


def columns(need: Measures, width: int, split: int = 0) -> Columns:
    """Divide `width` cells: the names get what the longest needs, or all but a few, but leave room for a value.

    `split` is the number of cells by which the user has moved the edge between names and values.
    """
    room = width - MARKS_CELLS
    name = max(1, min(need.name, room - GAP_CELLS - MIN_VALUE_CELLS))
    beside_bar = room - GAP_CELLS - need.number - GAP_CELLS - MIN_BAR_CELLS - END_CELLS
    if 0 < need.max_names <= beside_bar < name:
        name = beside_bar
    if split:
        name = min(max(MIN_NAME, name + split), max(1, room - GAP_CELLS - MIN_VALUE_CELLS))
    left = room - name - GAP_CELLS
    value = max(0, min(need.number, left))
    bar = max(0, min(BAR_CELLS, left - value - GAP_CELLS - END_CELLS))
    bar = bar if bar >= MIN_BAR_CELLS else 0
    left -= value + GAP_CELLS + bar if bar else value
    return Columns(name, value, bar, left - GAP_CELLS if bar and left - GAP_CELLS >= MIN_DESCRIPTION_CELLS else 0)
