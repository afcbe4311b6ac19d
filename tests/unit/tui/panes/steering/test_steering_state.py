"""The arithmetic of steering: limits, stopping at zero, the dead-man time."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree
from bot_console.tui.panes.steering.state import DEFAULT_LIMITS, Steering, limits_from_parameters


def armed_state(greatest: tuple[float, float] = (1.0, 3.0)) -> Steering:
    state = Steering(greatest=greatest)
    state.arm(0.0)
    return state


def test_command_stays_within_limits_and_stops_at_zero() -> None:
    state = armed_state()
    state.steer(1, 0, 100, 0.0)
    assert state.linear == 1.0
    state.steer(-1, 0, 30, 0.0)
    assert state.linear == 0.0
    state.steer(-1, 0, 100, 0.0)
    assert state.linear == -1.0


def test_twenty_steps_reach_the_limit_exactly() -> None:
    state = armed_state((0.7, 0.9))
    for _ in range(20):
        state.steer(1, -1, 1, 0.0)
    assert (state.linear, state.angular) == (0.7, -0.9)
    for _ in range(20):
        state.steer(-1, 1, 1, 0.0)
    assert (state.linear, state.angular) == (0.0, 0.0)


def test_new_limits_apply_at_once() -> None:
    state = armed_state()
    state.steer(1, 1, 20, 0.0)
    state.limit((0.2, 0.3))
    assert (state.linear, state.angular) == (0.2, 0.3)


def test_velocities_are_repeated_and_zero_is_sent_once() -> None:
    state = armed_state()
    assert state.command(0.0) is None
    state.steer(1, 0, 1, 0.0)
    assert state.command(0.1) == state.command(0.2) == (0.05, 0.0, 0.0)
    state.zero()
    assert state.command(0.3) == (0.0, 0.0, 0.0)
    assert state.command(0.4) is None


def test_the_deadman_time_is_exact() -> None:
    state = armed_state()
    state.steer(1, 0, 1, 10.0)
    assert state.left(11.0) == 0.5 and state.left(99.0) == 0.0
    assert state.command(11.999) == (0.05, 0.0, 0.0) and not state.expired
    assert state.command(12.0) == (0.0, 0.0, 0.0) and state.expired and not state.armed


def test_zero_is_sent_while_disarmed_even_if_sent_before() -> None:
    state = armed_state()
    state.disarm()
    assert state.command(0.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("parameters", "expected"),
    [
        ([], DEFAULT_LIMITS),
        ([("max_speed", Kind.DOUBLE, 2.0)], (2.0, DEFAULT_LIMITS[1])),
        ([("max_speed", Kind.DOUBLE, 2.0), ("turn_rate", Kind.DOUBLE, 0.5)], (2.0, 0.5)),
        ([("max_speed", Kind.STRING, "fast"), ("turn_rate", Kind.DOUBLE, -1.0)], DEFAULT_LIMITS),
    ],
)
def test_limits_come_from_parameters_that_are_positive_numbers(parameters, expected) -> None:
    infos = tuple(ParameterInfo("/r", name, kind, value) for name, kind, value in parameters)
    assert limits_from_parameters([ParameterTree("/r", infos)]) == expected


def test_limits_are_never_those_of_another_robot() -> None:
    def tree(node: str, speed: float) -> ParameterTree:
        return ParameterTree(node, (ParameterInfo(node, "max_speed", Kind.DOUBLE, speed),))

    fleet = [tree("/navigator", 0.5), tree("/robot2/navigator", 2.0), tree("/robot20/navigator", 4.0)]
    assert limits_from_parameters(fleet, "/cmd_vel", {"/robot2/", "/robot20/"})[0] == 0.5
    assert limits_from_parameters(fleet, "/robot2/cmd_vel", {"/", "/robot20/"})[0] == 2.0
    assert limits_from_parameters(fleet, "/robot3/cmd_vel", {"/", "/robot2/", "/robot20/"}) == DEFAULT_LIMITS
    assert limits_from_parameters(fleet[:1], "/base/cmd_vel")[0] == 0.5, "of one robot, wherever its nodes are"


def test_sideways_velocity_is_steered_limited_and_zeroed_like_the_others() -> None:
    state = Steering()
    state.limit((1.0, 3.0))
    state.arm(0.0)
    state.slide(2, 0.0)
    assert state.command(0.1) == (0.0, 0.0, 0.1)
    state.slide(-1000, 0.2)
    assert state.sideways == 0.0, "it stops before it changes its direction"
    state.slide(-1000, 0.3)
    assert state.sideways == -1.0
    state.limit((0.5, 3.0))
    assert state.sideways == -0.5
    assert state.command(0.4 + state.deadman) == (0.0, 0.0, 0.0) and state.expired
    state.arm(9.0)
    state.slide(1, 9.0)
    state.zero_axis(0, 9.0)
    assert state.command(9.1) == (0.0, 0.0, 0.0)
    state.slide(1, 9.2)
    state.zero()
    assert state.command(9.3) == (0.0, 0.0, 0.0)
