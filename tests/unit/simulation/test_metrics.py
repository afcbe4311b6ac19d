import hashlib
import math
import struct

import pytest
from bot_console_robot.simulation.figures.digest import PoseDigest
from bot_console_robot.simulation.figures.metrics import Metrics


def run(speeds: list[float], clearance: float = 1.0) -> Metrics:
    metrics = Metrics(0.1)
    for i, speed in enumerate(speeds):
        metrics.update(float(i), 0.0, 0.0, speed)
        metrics.pass_by(clearance)
    return metrics


def test_distance_counts_both_directions_and_mean_speed_is_over_all_time() -> None:
    metrics = run([1.0] * 10 + [-1.0] * 10 + [0.0] * 20)
    assert metrics.distance == pytest.approx(2.0)
    assert metrics.mean_speed == pytest.approx(0.5)
    assert metrics.duration == pytest.approx(4.0)


def test_stop_is_counted_when_the_robot_halts_after_driving() -> None:
    assert run([0.0] * 5).stops == 0
    assert run([1.0, 0.0, 0.0, 1.0, 0.0]).stops == 2
    assert run([1.0, 0.03, 1.0, 0.03]).stops == 0
    assert run([0.0, 0.03, 0.0]).stops == 0


def test_longest_standstill_is_reported() -> None:
    assert run([0.0] * 3 + [1.0] + [0.0] * 7 + [1.0]).longest_standstill == pytest.approx(0.7)
    assert run([1.0] * 3).longest_standstill == 0.0


def test_unknown_clearance_is_none_in_the_report() -> None:
    assert run([1.0], math.inf).report()["min_clearance"] is None
    assert run([1.0], 0.25).report()["min_clearance"] == 0.25


def test_digest_depends_on_the_poses_only() -> None:
    assert run([1.0, 2.0]).digest == run([2.0, 1.0]).digest
    assert run([1.0]).digest != run([1.0, 1.0]).digest


def test_digest_equals_the_hash_of_all_poses_at_any_time() -> None:
    digest, plain = PoseDigest(), hashlib.blake2b(digest_size=16)
    for number in range(1000):
        pose = 0.1 * number, -0.2 * number, math.sin(number)
        digest.add(*pose)
        plain.update(struct.pack("<3d", *pose))
        if number % 301 == 0:
            assert digest.hex == plain.hexdigest()
    assert digest.hex == digest.hex == plain.hexdigest()
