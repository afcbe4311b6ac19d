import math

import numpy as np
import pytest
from bot_console_robot.safety.obstacle_ahead import nearest_ahead

FIRST, STEP = -math.pi / 2, math.pi / 359


def scan(**at: float) -> np.ndarray:
    ranges = np.full(360, math.inf, np.float32)
    for beam, value in at.items():
        ranges[int(beam[1:])] = value
    return ranges


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
