import math

import numpy as np
import pytest
from bot_console_robot.arbitration import Arbiter, Command, limit, nearest_ahead

FIRST, STEP = -math.pi / 2, math.pi / 359


def scan(**at: float) -> np.ndarray:
    ranges = np.full(360, math.inf, np.float32)
    for beam, value in at.items():
        ranges[int(beam[1:])] = value
    return ranges


def test_the_first_source_with_a_fresh_command_drives() -> None:
    arbiter = Arbiter(("teleop", "navigation"), 500)
    assert arbiter.choose(0) is None
    arbiter.offer("navigation", 1.0, 0.1, 0)
    arbiter.offer("teleop", 0.2, 0.3, 100)
    assert arbiter.choose(100) == Command("teleop", 0.2, 0.3, 100)
    assert arbiter.choose(500) == Command("teleop", 0.2, 0.3, 100)
    arbiter.offer("navigation", 0.9, 0.0, 600)
    assert arbiter.choose(601) == Command("navigation", 0.9, 0.0, 600)
    assert arbiter.choose(1101) is None


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_is_no_number_is_a_stop(value: float) -> None:
    arbiter = Arbiter(("a",), 500)
    arbiter.offer("a", value, 1.0, 0)
    command = arbiter.choose(0)
    assert command is not None
    assert (command.linear, command.angular) == (0.0, 0.0)


def test_one_beam_is_no_obstacle_and_two_are() -> None:
    assert nearest_ahead(scan(b180=0.3), FIRST, STEP) == math.inf
    assert nearest_ahead(scan(b180=0.3, b181=0.31), FIRST, STEP) == pytest.approx(0.31)


def test_things_beside_the_robot_are_not_ahead() -> None:
    assert nearest_ahead(scan(b0=0.2, b1=0.2, b358=0.2, b359=0.2), FIRST, STEP) == math.inf
    assert nearest_ahead(scan(b61=0.2, b62=0.2), FIRST, STEP) == pytest.approx(0.2)


def test_too_near_to_measure_is_zero_and_nan_is_nothing() -> None:
    assert nearest_ahead(scan(b180=-math.inf, b181=-math.inf), FIRST, STEP) == 0.0
    assert nearest_ahead(scan(b180=math.nan, b181=math.nan), FIRST, STEP) == math.inf
    assert nearest_ahead(np.empty(0, np.float32), FIRST, STEP) == math.inf
    assert nearest_ahead(scan(b180=0.1, b181=0.1), FIRST, 0.0) == math.inf


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
def test_distances_limit_driving_forward_only(linear: float, nearest: float, final: float, why: str) -> None:
    verdict = limit(Command("nav", linear, 0.7, 0), nearest, 0.3, 0.7)
    assert verdict.final == pytest.approx((final, 0.7))
    assert verdict.asked == (linear, 0.7)
    assert verdict.limited_by == why
