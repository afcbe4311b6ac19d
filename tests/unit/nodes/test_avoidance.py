import math
from dataclasses import replace

import numpy as np
import pytest
from bot_console_robot.avoidance import Avoidance, Decision, Rules

RULES = Rules(1.0, 0.5, 100, 1.0, True)
BEAMS = 361
FIRST, STEP = -math.pi / 2, math.pi / 360
ANGLES = FIRST + STEP * np.arange(BEAMS)


def wall_ahead(distance: float) -> np.ndarray:
    with np.errstate(divide="ignore"):
        return (distance / np.maximum(np.cos(ANGLES), 1e-9)).astype(np.float32)


def ranges_with_obstacle(angle: float, distance: float, width: float = 0.2) -> np.ndarray:
    ranges = np.full(BEAMS, math.inf, np.float32)
    ranges[np.abs(ANGLES - angle) < width / 2 / distance] = distance
    return ranges


def decide(ranges: np.ndarray, rules: Rules = RULES, intensity: float = 200.0) -> Decision:
    intensities = np.full(len(ranges), intensity, np.float32)
    return Avoidance().decide(ranges.astype(np.float32), intensities, FIRST, STEP, rules)


def test_robot_drives_at_full_speed_without_obstacles() -> None:
    decision = decide(np.full(BEAMS, math.inf))
    assert decision.linear == pytest.approx(1.0)
    assert not decision.blocked
    assert decision.nearest == math.inf


@pytest.mark.parametrize("speed", [0.5, 1.0, 3.0])
def test_max_speed_limits_the_command(speed: float) -> None:
    assert decide(np.full(BEAMS, math.inf), replace(RULES, max_speed=speed)).linear == pytest.approx(speed)


def test_robot_slows_down_before_a_wall_and_stops_at_safety_distance() -> None:
    fast = replace(RULES, max_speed=3.0)
    speeds = [decide(wall_ahead(d), fast).linear for d in (3.0, 1.5, 0.8, 0.55, 0.49)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[-1] == 0.0
    assert decide(wall_ahead(0.49), fast).blocked


def test_greater_safety_distance_stops_earlier() -> None:
    assert not decide(wall_ahead(0.8)).blocked
    assert decide(wall_ahead(0.8), replace(RULES, safety_distance=0.9)).blocked


def test_robot_drives_on_if_safety_is_disabled() -> None:
    decision = decide(wall_ahead(0.3), replace(RULES, enable_safety=False))
    assert decision.linear == 1.0
    assert not decision.blocked


@pytest.mark.parametrize("rate", [0.3, 2.0])
def test_turn_rate_limits_turning_both_ways(rate: float) -> None:
    rules = replace(RULES, turn_rate=rate)
    assert abs(decide(wall_ahead(0.3), rules).angular) == rate
    corridor = np.where(np.abs(ANGLES - math.pi / 2) < 0.6, math.inf, 0.7)
    assert abs(decide(corridor, rules).angular) <= rate


@pytest.mark.parametrize(("angle", "sign"), [(0.3, -1), (-0.3, 1)])
def test_robot_steers_away_from_an_obstacle(angle: float, sign: int) -> None:
    assert math.copysign(1, decide(ranges_with_obstacle(angle, 1.2, 0.6)).angular) == sign


def test_weak_returns_count_only_below_the_threshold() -> None:
    blocked = wall_ahead(0.4)
    assert decide(blocked, replace(RULES, detection_threshold=100), intensity=100.0).blocked
    assert not decide(blocked, replace(RULES, detection_threshold=101), intensity=100.0).blocked
    assert decide(blocked, replace(RULES, detection_threshold=101), intensity=100.0).nearest == math.inf


def test_scan_without_intensities_counts_fully() -> None:
    decision = Avoidance().decide(wall_ahead(0.4), np.empty(0, np.float32), FIRST, STEP, RULES)
    assert decision.blocked


def test_turning_side_is_kept_until_the_way_is_free() -> None:
    avoidance = Avoidance()
    full = np.full(BEAMS, 200.0, np.float32)
    left_free = np.where(ANGLES > 0.8, 3.0, 0.4).astype(np.float32)
    right_free = left_free[::-1].copy()
    first = avoidance.decide(left_free, full, FIRST, STEP, RULES)
    second = avoidance.decide(right_free, full, FIRST, STEP, RULES)
    assert first.blocked
    assert second.blocked
    assert first.angular == second.angular == 1.0
    avoidance.decide(np.full(BEAMS, math.inf, np.float32), full, FIRST, STEP, RULES)
    assert avoidance.decide(right_free, full, FIRST, STEP, RULES).angular == -1.0


@pytest.mark.parametrize("ranges", [[], [math.nan] * 5, [0.0, -math.inf, math.inf, math.nan, 0.0]])
def test_empty_scan_is_a_free_way(ranges: list[float]) -> None:
    decision = decide(np.array(ranges, np.float32))
    assert not decision.blocked
    assert math.isfinite(decision.linear)
    assert math.isfinite(decision.angular)
