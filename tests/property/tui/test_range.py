"""Whatever a descriptor says, keys and the slider send only values that rclpy accepts, and reach its whole grid."""

from __future__ import annotations

import math
from typing import Any

from bot_console.runtime.rclpy.node_parts.parameter_setting import refusal
from bot_console.tui.console.model import Kind, ParameterInfo
from bot_console.tui.console.values import info
from bot_console.tui.panes.parameters.editing import at_share, moved_by_steps
from bot_console.tui.panes.parameters.table import slider_text
from hypothesis import example, given
from hypothesis import strategies as st
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, ParameterValue
from rclpy.node import Node
from rclpy.parameter import Parameter

KEYS = (1, -1, 10, -10)
"""The steps of + - > <."""
INT64_MIN, INT64_MAX = -(2**63), 2**63 - 1

integer = st.one_of(st.integers(-20, 20), st.integers(INT64_MIN, INT64_MAX), st.sampled_from([INT64_MIN, INT64_MAX]))
integers = st.builds(
    IntegerRange, from_value=integer, to_value=integer, step=st.one_of(st.integers(0, 9), st.integers(0, 2**64 - 1))
)
double = st.one_of(
    st.integers(-1000, 1000).map(lambda each: each / 10),
    st.floats(-1e-9, 1e-9),
    st.floats(1.0, 1.0 + 1e-14),
    st.floats(),
)
doubles = st.builds(
    FloatingPointRange,
    from_value=double,
    to_value=double,
    step=st.one_of(st.just(0.0), st.sampled_from([0.1, 0.25, 0.3, 3e-10, 7.0]), st.floats()),
)


def parameter_and_descriptor(allowed: Any, value: float) -> tuple[ParameterInfo, ParameterDescriptor]:
    """A parameter with a range, as the console sees it, and its descriptor."""
    whole = isinstance(allowed, IntegerRange)
    kind = Kind.INTEGER if whole else Kind.DOUBLE
    descriptor = ParameterDescriptor(name="it", type=int(kind))
    if whole:
        descriptor.integer_range = [allowed]
        message = ParameterValue(type=int(kind), integer_value=int(value))
    else:
        descriptor.floating_point_range = [allowed]
        message = ParameterValue(type=int(kind), double_value=value)
    return info("/node", message, descriptor, None), descriptor


def reason(value: Any, descriptor: ParameterDescriptor) -> str | None:
    """Why rclpy refuses a value; None if it accepts it."""
    given = Parameter("it", value=value)
    return refusal(given, descriptor, check_read_only=True, declared=True, tolerance=Node.PARAM_REL_TOL)


@given(st.one_of(integers, doubles), st.lists(st.one_of(st.sampled_from(KEYS), st.floats(-0.5, 1.5)), max_size=12))
@example(FloatingPointRange(from_value=0.0, to_value=1.0, step=0.25), [1, 1, -1, 0.3])
@example(FloatingPointRange(from_value=0.0, to_value=1.0, step=0.3), [10, -1, 1, 1, 0.99])
@example(FloatingPointRange(from_value=-0.3, to_value=1.0, step=0.1), [1, 1, 1, 1])
@example(FloatingPointRange(from_value=1e-12, to_value=2e-12), [1, 10, 0.5])
@example(IntegerRange(from_value=0, to_value=INT64_MAX), [1.0, -1, 1, 0.5])
@example(IntegerRange(from_value=1, to_value=20, step=7), [1, 1, 1, -1, 0.6])
@example(IntegerRange(from_value=INT64_MIN, to_value=INT64_MAX, step=2**64 - 1), [1, 0.5, -1])
def test_every_value_that_keys_and_slider_send_is_accepted(allowed: Any, moves: list[Any]) -> None:
    first = min(allowed.from_value, allowed.to_value)
    parameter, descriptor = parameter_and_descriptor(allowed, first)
    for move in moves:
        assert len(slider_text(parameter, 12)) in (0, 12)
        value = (
            at_share(parameter, move) if isinstance(move, float) else moved_by_steps(parameter, parameter.value, move)
        )
        if value is not None:
            assert type(value) is type(parameter.value) and math.isfinite(value)
            assert reason(value, descriptor) is None, f"{value} in {allowed} after {move}"
            parameter, _ = parameter_and_descriptor(allowed, value)


@given(
    st.one_of(
        st.builds(IntegerRange, from_value=integer, to_value=st.just(0), step=st.integers(1, 9)),
        st.builds(
            FloatingPointRange,
            from_value=st.integers(-50, 50).map(lambda each: each / 10),
            to_value=st.just(0.0),
            step=st.sampled_from([0.05, 0.1, 0.25, 0.3, 1.0, 1 / 3]),
        ),
    ),
    st.integers(1, 40),
)
def test_all_points_of_a_grid_can_be_reached_upwards_and_downwards(allowed: Any, points: int) -> None:
    low, step = allowed.from_value, allowed.step
    whole = isinstance(allowed, IntegerRange)
    if whole:
        low = allowed.from_value = min(low, INT64_MAX - points * step)
    allowed.to_value = low + points * step
    grid = [low + at * step for at in range(points + 1)]
    walked, back = [low], [allowed.to_value]
    for _ in range(points):
        for path, way in ((walked, 1), (back, -1)):
            parameter, _ = parameter_and_descriptor(allowed, path[-1])
            path.append(moved_by_steps(parameter, parameter.value, way))
    assert (walked[-1], back[-1]) == (allowed.to_value, low)
    assert all(map(math.isclose, back[::-1], walked))
    assert (
        walked == grid
        if whole
        else all(math.isclose(*pair, rel_tol=1e-6, abs_tol=1e-12) for pair in zip(walked, grid, strict=True))
    )
    parameter, _ = parameter_and_descriptor(allowed, low)
    shown = [at_share(parameter, at / points) for at in range(points + 1)]
    assert all(map(math.isclose, shown, walked))


@given(st.one_of(st.integers(INT64_MIN, INT64_MAX), st.floats()), st.sampled_from(KEYS))
def test_a_number_without_a_range_stays_a_number_that_a_parameter_can_hold(value: Any, steps: int) -> None:
    kind = Kind.DOUBLE if isinstance(value, float) else Kind.INTEGER
    moved = moved_by_steps(ParameterInfo("/node", "it", kind, value), value, steps)
    if kind is Kind.INTEGER:
        assert isinstance(moved, int) and INT64_MIN <= moved <= INT64_MAX
    else:
        assert moved is None or (isinstance(moved, float) and math.isfinite(moved))
