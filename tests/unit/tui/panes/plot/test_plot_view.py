"""Plots as numbers and text: reduction, limits, ticks, gaps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from bot_console.tui.panes.plot.curves import Curve, column_ranges
from bot_console.tui.panes.plot.time_window import limits_of, limits_problem, zoom_limits
from bot_console.tui.panes.plot.view import Axes, Mark, framed_plot, legend, limits, short_number, strips, tick_step
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len


def curve(values: list[float], rate: float = 10.0, path: str = "/t/data") -> Curve:
    return Curve(path, 0, np.arange(len(values)) / rate, np.array(values, float))


def width_of(line: tuple[tuple[str, str], ...]) -> int:
    return sum(cell_len(text) for text, _ in line)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=300), st.integers(4, 60))
def test_peaks_are_drawn_with_many_samples_per_column(values: list[float], columns: int) -> None:
    shown = curve(values)
    seen = column_ranges(*shown.between(0.0, shown.times[-1]), 0.0, float(shown.times[-1]), columns)
    assert np.nanmax(seen.high) == pytest.approx(max(values), abs=1e-9)
    assert np.nanmin(seen.low) == pytest.approx(min(values), abs=1e-9)
    assert not np.isnan(seen.low).any()


def test_value_that_is_not_finite_leaves_only_a_gap() -> None:
    shown = curve([1.0] * 10 + [math.nan, math.inf, -math.inf] + [1.0] * 10)
    seen = column_ranges(*shown.between(0.0, 2.2), 0.0, 2.2, 22)
    gap = np.isnan(seen.low)
    assert gap[10:12].all() and not gap[:9].any() and not gap[14:].any()


def test_a_parameter_holds_its_value_until_the_next_change() -> None:
    shown = Curve("/n:p", 0, np.array([1.0, 5.0]), np.array([2.0, 3.0]))
    times, values = shown.between(0.0, 8.0)
    assert times.tolist() == [1.0, 5.0, 5.0, 8.0] and values.tolist() == [2.0, 2.0, 3.0, 3.0]


def test_nothing_is_drawn_before_the_first_sample() -> None:
    shown = curve([1.0, 2.0])
    seen = column_ranges(*shown.between(-5.0, 0.1), -5.0, 0.1, 51)
    assert np.isnan(seen.low[:49]).all()


@pytest.mark.parametrize(
    ("span", "maximum", "step"), [(10, 5, 2), (1, 4, 0.5), (7, 10, 1), (0.03, 6, 0.005), (0, 5, 1)]
)
def test_ticks_are_at_round_numbers(span: float, maximum: int, step: float) -> None:
    assert tick_step(span, maximum) == pytest.approx(step)


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-2.0, 0.0), (0.0, 0.99), (1000.0, 2000.0), (3.0, 7.3)])
def test_a_curve_at_its_limit_has_head_room(low: float, high: float) -> None:
    seen = column_ranges(np.array([0.0, 1.0]), np.array([low, high]), 0.0, 1.0, 4)
    bottom, top = limits([seen])
    assert top - high >= 0.05 * (high - low) and bottom <= low


@given(st.floats(-1e9, 1e9), st.floats(0, 1e6))
def test_limits_enclose_all_values_and_never_coincide(low: float, span: float) -> None:
    seen = column_ranges(np.array([0.0, 1.0]), np.array([low, low + span]), 0.0, 1.0, 4)
    bottom, top = limits([seen])
    slack = 1e-9 * max(1.0, abs(low), abs(low + span))
    assert bottom <= low + slack and top >= low + span - slack and top > bottom


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), max_size=60), st.integers(16, 130), st.integers(4, 40))
def test_any_series_is_drawn_in_the_requested_width(values: list[float], width: int, height: int) -> None:
    axes = Axes(0.0, 5.0)
    lines = framed_plot([curve(values)], [Mark(1.0), Mark(2.0, True), Mark(99.0)], axes, width, height)
    assert len(lines) == height
    assert {width_of(line) for line in lines} == {width}
    assert len(strips([curve(values), curve(values)], axes, width, height, 0)) <= height


@pytest.mark.parametrize("limits", [(-1e300, 1e300), (1e300, math.nextafter(1e300, math.inf)), (0.0, 5e-324)])
def test_extreme_values_and_limits_are_drawn(limits: tuple[float, float]) -> None:
    for values in (list(limits), [-1.7e308, 1.7e308]):
        for axes in (Axes(0.0, 5.0), Axes(0.0, 5.0, limits)):
            assert len(framed_plot([curve(values)], [], axes, 60, 20)) == 20


@given(st.floats(allow_nan=True, allow_infinity=True), st.sampled_from([0.0, 1e-7, 0.01, 0.5, 1.0, 20.0, 1e9]))
def test_numbers_fit_their_place(value: float, step: float) -> None:
    assert len(short_number(value, step)) <= 7


def test_legend_shows_the_newest_value_and_window_figures() -> None:
    text = "".join(each for each, _ in legend(curve([1.0, 3.0, math.nan, 2.0]), Axes(0.0, 1.0), 100, True))
    assert "2.000" in text and "min 1.000  max 3.000  mean 2.000" in text and "1 not finite" in text


@pytest.mark.parametrize("text", ["1", "a b", "2 1", "1 1", "nan 2", "1 2 3", "inf 3", "-1.7e308 1.7e308"])
def test_invalid_limits_are_rejected(text: str) -> None:
    assert limits_problem(text)


def test_limits_are_two_numbers_or_none() -> None:
    assert limits_of("") is None and limits_of("-1 .. 2.5") == (-1.0, 2.5) and limits_of("0, 4") == (0.0, 4.0)


@pytest.mark.parametrize(
    ("value", "shown"),
    [(3347.0, "3347.00"), (123.456, "123.456"), (99999.0, "99999.0"), (-3347.25, "-3347.2"), (0.5, "0.500")],
)
def test_the_legend_writes_numbers_of_many_digits_out(value: float, shown: str) -> None:
    line = "".join(text for text, _ in legend(curve([value]), Axes(0.0, 2.0), 100, False))
    assert f" {shown} " in line and "e+" not in line


def test_zoom_keeps_the_value_in_its_place_and_stays_within_bounds() -> None:
    assert zoom_limits((0.0, 4.0), 1.0, 0.5) == (0.5, 2.5)
    assert zoom_limits(zoom_limits((0.0, 4.0), 1.0, 0.5), 1.0, 2) == (0.0, 4.0)
    assert (
        zoom_limits((0.0, 4.0), None, 0.5)
        == zoom_limits((0.0, 4.0), 9.0, 0.5)
        == zoom_limits((0.0, 4.0), math.nan, 0.5)
        == (1.0, 3.0)
    )
    tiny, huge = (1.0, 1.0 + 1e-9), (-5e11, 5e11)
    assert zoom_limits(tiny, None, 0.5) == tiny and zoom_limits(huge, None, 2) == huge
