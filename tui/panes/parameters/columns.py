"""The column widths of the parameter pane: names get room before values, and values before descriptions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from bot_console.tui.console.model import Value
from bot_console.tui.console.parameters.unit import unit_of
from bot_console.tui.format import harmless, value_text
from bot_console.tui.panes.parameters.rows import Row
from rich.cells import cell_len

BAR = 12
"""Cells of the slider."""

MARKS = 2
"""Cells of the marks before a name."""
GAP = 2
VALUE = 8
"""Cells that a value has at least."""

DESCRIPTION = 20
"""A description has at least these cells, or none."""


@dataclass(frozen=True)
class Measures:
    """What the rows need, in cells: the longest name with its indentation, the longest number that has a slider."""

    name: int = 0
    number: int = VALUE


@dataclass(frozen=True)
class Columns:
    """Cells of each column behind the mark; 0: the column is left out."""

    name: int
    value: int
    bar: int
    description: int


def measured(rows: Sequence[Row]) -> Measures:
    """Measure the rows; numbers in steps of two cells, so that the columns stand while a value moves."""
    name, number = 0, VALUE
    for row in rows:
        if row.parameter is None:
            continue
        name = max(name, 2 * row.depth + _name_cells(row.name))
        if row.parameter.range is not None:
            number = max(number, _number_cells(row.parameter.value, row.parameter.description))
    return Measures(name, -(-number // 2) * 2)


@lru_cache(maxsize=20_000)
def _name_cells(name: str) -> int:
    return cell_len(harmless(name))


@lru_cache(maxsize=20_000, typed=True)
def _number_cells(value: Value, description: str) -> int:
    """Cells of a value and its unit; thousands are asked for at each key of a filter, and few are new."""
    unit = unit_of(description)
    return cell_len(value_text(value)) + (cell_len(unit) + 1 if unit else 0)


def shown_value(row: Row) -> str:
    """The value of a parameter with its unit."""
    parameter = row.parameter
    if parameter is None:
        return ""
    return harmless(value_text(parameter.value)) + (f" {parameter.unit}" if parameter.unit else "")


def columns(need: Measures, width: int) -> Columns:
    """Share a width (cells): the names take what the longest needs, and leave a value its place."""
    room = width - MARKS
    name = max(1, min(need.name, room - GAP - VALUE))
    left = room - name - GAP
    value = max(0, min(need.number, left))
    bar = BAR if left - value >= GAP + BAR else 0
    left -= value + GAP + BAR if bar else value
    return Columns(name, value, bar, left - GAP if bar and left - GAP >= DESCRIPTION else 0)
