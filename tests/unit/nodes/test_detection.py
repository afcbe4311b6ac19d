import math

import numpy as np
import pytest
from bot_console_robot.detection import find, median_of_three, without_weak_returns

INF = math.inf


def floats(*values: float) -> np.ndarray:
    return np.array(values, np.float32)


def test_median_removes_single_beams_only() -> None:
    assert median_of_three(floats(5, 5, 1, 5, 5)).tolist() == [5, 5, 5, 5, 5]
    assert median_of_three(floats(INF, INF, 1, INF, INF)).tolist() == [INF] * 5
    assert median_of_three(floats(5, 5, 1, 1, 5, 5)).tolist() == [5, 5, 1, 1, 5, 5]
    assert median_of_three(floats(5, 1)).tolist() == [5, 1]


def test_median_equals_numpys() -> None:
    ranges = np.random.default_rng(1).random(200).astype(np.float32)
    stacked = np.stack([ranges[:-2], ranges[1:-1], ranges[2:]])
    assert (median_of_three(ranges)[1:-1] == np.median(stacked, axis=0)).all()


def test_weak_returns_are_removed() -> None:
    assert without_weak_returns(floats(1, 2, 3), floats(99, 100, 101), 100).tolist() == [INF, 2, 3]
    assert without_weak_returns(floats(1, 2), floats(), 100).tolist() == [1, 2]


def test_groups_of_beams_are_objects() -> None:
    ranges = np.full(360, INF, np.float32)
    ranges[100:120] = 2.0
    ranges[200:210] = 1.0
    ranges[300:302] = 1.0
    step = math.pi / 359
    right, left = find(ranges, -math.pi / 2, step)
    assert right.distance == 2.0
    assert left.distance == 1.0
    assert math.atan2(right.y, right.x) == pytest.approx(-math.pi / 2 + 109.5 * step, abs=1e-3)
    assert left.width == pytest.approx(9 * step, rel=0.01)


def test_jump_in_depth_separates_two_objects() -> None:
    ranges = np.concatenate([np.full(20, 2.0), np.full(20, 3.0)]).astype(np.float32)
    assert len(find(ranges, 0.0, 0.01)) == 2


def test_empty_scan_has_no_objects() -> None:
    assert find(floats(INF, math.nan, -INF, 0.0), 0.0, 0.01) == []
    assert find(floats(), 0.0, 0.01) == []
