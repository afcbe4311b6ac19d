import math

import numpy as np
import pytest
from bot_console_robot.safety.arbitration import Arbiter, Command, limit, nearest_ahead

FIRST, STEP = -math.pi / 2, math.pi / 359


def scan(**at: float) -> np.ndarray:
    ranges = np.full(360, math.inf, np.float32)
    for beam, value in at.items():
        ranges[int(beam[1:])] = value
    return ranges


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


def test_two_beams_make_an_obstacle_and_one_does_not() -> None:
    assert nearest_ahead(scan(b180=0.3), FIRST, STEP) == math.inf
    assert nearest_ahead(scan(b180=0.3, b181=0.31), FIRST, STEP) == pytest.approx(0.31)


def test_obstacles_beside_the_robot_are_not_ahead() -> None:
    assert nearest_ahead(scan(b0=0.2, b1=0.2, b358=0.2, b359=0.2), FIRST, STEP) == math.inf
    assert nearest_ahead(scan(b61=0.2, b62=0.2), FIRST, STEP) == pytest.approx(0.2)


def test_too_near_to_measure_is_zero_and_nan_is_ignored() -> None:
    assert nearest_ahead(scan(b180=-math.inf, b181=-math.inf), FIRST, STEP) == 0.0
    assert nearest_ahead(scan(b180=math.nan, b181=math.nan), FIRST, STEP) == math.inf


@pytest.mark.parametrize("increment", [0.0, math.nan, math.inf, -math.inf, 1e30])
def test_scan_with_invalid_angles_is_unusable(increment: float) -> None:
    assert nearest_ahead(scan(b180=0.1, b181=0.1), FIRST, increment) is None
    assert nearest_ahead(scan(b180=0.1, b181=0.1), math.nan if math.isfinite(increment) else increment, STEP) is None


def test_scan_without_measurements_ahead_is_unusable() -> None:
    assert nearest_ahead(np.empty(0, np.float32), FIRST, STEP) is None
    assert nearest_ahead(np.full(360, math.nan, np.float32), FIRST, STEP) is None


def test_beams_may_turn_either_way_and_start_anywhere() -> None:
    assert nearest_ahead(scan(b180=0.2, b181=0.2), -FIRST, -STEP) == pytest.approx(0.2)
    ahead = np.full(360, math.inf, np.float32)
    ahead[[359, 0, 180]] = 0.4, 0.3, 0.1
    assert nearest_ahead(ahead, 0.0, math.tau / 360) == pytest.approx(0.4), "all round, from straight ahead"


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
