import math

import pytest
from bot_console_robot.safety.arbitration import Arbiter, Command, limit


class Clock:
    """A clock that is set by hand."""

    def __init__(self) -> None:
        self.now = 0

    def __call__(self) -> int:
        return self.now


def test_first_source_with_a_fresh_command_drives() -> None:
    clock = Clock()
    arbiter = Arbiter({"teleop": clock, "navigation": clock}, 500)
    assert arbiter.choose() is None
    arbiter.offer("navigation", 1.0, 0.1)
    clock.now = 100
    arbiter.offer("teleop", 0.2, 0.3)
    assert arbiter.choose() == Command("teleop", 0.2, 0.3, 100)
    clock.now = 500
    assert arbiter.choose() == Command("teleop", 0.2, 0.3, 100)
    clock.now = 600
    arbiter.offer("navigation", 0.9, 0.0)
    clock.now = 601
    assert arbiter.choose() == Command("navigation", 0.9, 0.0, 600)
    assert arbiter.choose("navigation") is None
    clock.now = 1101
    assert arbiter.choose() is None


def test_each_source_ages_by_its_own_clock() -> None:
    wall, world = Clock(), Clock()
    arbiter = Arbiter({"teleop": wall, "navigation": world}, 500)
    arbiter.offer("teleop", 0.2, 0.0)
    arbiter.offer("navigation", 0.9, 0.0)
    wall.now = 5000
    chosen = arbiter.choose()
    assert chosen and chosen.source == "navigation"


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_command_that_is_not_finite_is_a_stop(value: float) -> None:
    arbiter = Arbiter({"a": Clock()}, 500)
    arbiter.offer("a", value, 1.0)
    command = arbiter.choose()
    assert command is not None
    assert (command.linear, command.angular) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("linear", "nearest", "final", "why"),
    [
        (1.0, 2.0, 1.0, ""),
        (1.0, 0.7, 1.0, ""),
        (1.0, 0.5, 0.5, "warning_distance"),
        (1.0, 0.3, 0.0, "warning_distance"),
        (1.0, 0.29, 0.0, "emergency_stop_distance"),
        (-1.0, 0.1, -1.0, ""),
        (0.0, 0.1, 0.0, ""),
        (1.0, math.inf, 1.0, ""),
    ],
)
def test_distances_limit_only_forward_driving(linear: float, nearest: float, final: float, why: str) -> None:
    verdict = limit(Command("nav", linear, 0.7, 0), nearest, 0.3, 0.7)
    assert verdict.final == pytest.approx((final, 0.7))
    assert verdict.asked == (linear, 0.7)
    assert verdict.limited_by == why
