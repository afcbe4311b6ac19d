"""The columns of the parameter pane: names, values, sliders, descriptions."""

from __future__ import annotations

from bot_console.tui.console.model import Kind, ParameterInfo, Range
from bot_console.tui.panes.parameters.columns import (
    BAR_CELLS,
    GAP_CELLS,
    MARKS_CELLS,
    MIN_BAR_CELLS,
    MIN_NAME,
    MIN_VALUE_CELLS,
    Columns,
    columns,
    measure,
    name_column,
)
from bot_console.tui.panes.parameters.rows import Row

LONG = "auto.target_mean_brightness_of_region_of_interest"


def row(name: str) -> Row:
    return Row("/n", name, 1, ParameterInfo("/n", name, Kind.DOUBLE, 1.0, range=Range(0.0, 2.0)))


def needed_cells(own: Columns) -> int:
    """The number of cells that all columns need."""
    return MARKS_CELLS + own.name + GAP_CELLS + own.value + (GAP_CELLS + own.bar if own.bar else 0)


def test_longest_name_fits_and_slider_takes_the_rest() -> None:
    need = measure([row("gain"), row("emergency_stop_distance")])
    widths = {width: columns(need, width) for width in range(30, 90)}
    name = 2 + len("emergency_stop_distance")
    assert {each.bar for each in widths.values()} == {0, *range(MIN_BAR_CELLS, BAR_CELLS + 1)}
    assert all(each.name == name and needed_cells(each) <= width for width, each in widths.items() if each.bar)


def test_single_long_name_does_not_remove_all_sliders() -> None:
    rows = [row(f"gain_{number}") for number in range(20)]
    need = measure([*rows, row(LONG)])
    own = columns(need, 60)
    assert own.bar >= MIN_BAR_CELLS and needed_cells(own) <= 60
    assert name_column(rows[0], own, 60) == own.name
    over = name_column(row(LONG), own, 60)
    assert over > own.name and MARKS_CELLS + over + GAP_CELLS + MIN_VALUE_CELLS <= 60, (
        "it exceeds its column, and its value stays visible"
    )
    assert columns(need, 100).name == 2 + len(LONG), "if there is room, all names fit into the column"
    assert not columns(measure([rows[0], row(LONG)]), 60).bar, "one of two is too many to exceed the column"


def test_moved_edge_shifts_room_but_leaves_some_for_names_and_values() -> None:
    need = measure([row("gain"), row("emergency_stop_distance")])
    own, wider, narrower = (columns(need, 52, split) for split in (0, 6, -6))
    assert (wider.name, narrower.name) == (own.name + 6, own.name - 6)
    assert wider.bar < own.bar and all(needed_cells(each) <= 52 for each in (wider, narrower))
    far = [columns(need, 52, split) for split in (-100, 100)]
    assert far[0].name == MIN_NAME and far[1].value >= MIN_VALUE_CELLS
    assert name_column(row("emergency_stop_distance"), narrower, 52, -6) == narrower.name, "the name is cut"
