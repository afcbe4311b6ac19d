import itertools
import math

import pytest
from bot_console_robot.motion import CRUISE_M_S, DETOUR_S, Gains, VelocityController, WaypointFollower

GAINS = Gains(3.0, 6.0, 1.0)


def test_speeding_up_respects_acceleration_and_reaches_target() -> None:
    controller = VelocityController()
    speeds = [controller.step(2.0, 0.0, 0.05, GAINS)[0] for _ in range(120)]
    assert speeds[0] == pytest.approx(0.05)
    assert max(b - a for a, b in itertools.pairwise(speeds)) <= 0.05 + 1e-12
    assert speeds[-1] == pytest.approx(2.0, abs=0.01)
    assert max(speeds) <= 2.0


def test_slowing_down_is_immediate() -> None:
    controller = VelocityController()
    for _ in range(100):
        controller.step(1.0, 0.0, 0.05, GAINS)
    assert controller.step(0.2, 0.0, 0.05, GAINS)[0] == 0.2
    assert controller.step(0.0, 0.0, 0.05, GAINS)[0] == 0.0


def test_reversing_goes_through_the_ramp() -> None:
    controller = VelocityController()
    for _ in range(100):
        controller.step(1.0, 0.0, 0.05, GAINS)
    assert controller.step(-1.0, 0.0, 0.05, GAINS)[0] == pytest.approx(0.95, abs=0.01)


def test_greater_gain_is_faster() -> None:
    slow, fast = VelocityController(), VelocityController()
    for _ in range(5):
        slow.step(0.1, 1.0, 0.05, Gains(1.0, 1.0, 10.0))
        fast.step(0.1, 1.0, 0.05, Gains(8.0, 8.0, 10.0))
    assert fast.linear > slow.linear
    assert fast.angular > slow.angular


@pytest.mark.parametrize("gain", [0.1, 20.0])
def test_no_gain_exceeds_the_turn_rate(gain: float) -> None:
    controller = VelocityController()
    for _ in range(400):
        assert controller.step(0.0, 1.0, 0.05, Gains(1.0, gain, 1.0))[1] <= 1.0


def drive(follower: WaypointFollower, gains: Gains, seconds: float = 60.0) -> list[tuple[float, float]]:
    x, y, heading = 0.0, 0.0, 0.0
    track = []
    for _ in range(int(seconds / 0.05)):
        follower.arrived(x, y)
        if follower.target is None:
            break
        v, w = follower.steer((x, y, heading), None, 0.05, gains)
        heading += max(-2.0, min(2.0, w)) * 0.05
        x, y = x + v * math.cos(heading) * 0.05, y + v * math.sin(heading) * 0.05
        track.append((x, y))
    return track


def test_waypoints_are_reached_in_order() -> None:
    follower = WaypointFollower()
    follower.follow([(2.0, 0.0), (2.0, 2.0), (-1.0, -1.0)])
    track = drive(follower, GAINS)
    assert follower.target is None
    nearest = [min(range(len(track)), key=lambda i: math.dist(track[i], p)) for p in ((2, 0), (2, 2), (-1, -1))]
    assert nearest == sorted(nearest)


def test_loop_starts_again_at_the_first_waypoint() -> None:
    follower = WaypointFollower()
    follower.follow([(1.0, 0.0), (0.0, 0.0)], loop=True)
    drive(follower, GAINS, 30.0)
    assert follower.target is not None
    follower.follow([])
    assert follower.target is None


def test_speed_stays_within_its_limit() -> None:
    follower = WaypointFollower()
    follower.follow([(5.0, 0.0)])
    assert follower.steer((0, 0, 0), None, 0.05, GAINS)[0] == CRUISE_M_S
    assert follower.steer((0, 0, 0), (0.2, 0.0), 0.05, GAINS)[0] == 0.2
    assert follower.steer((4.9, 0, 0), (2.0, 0.0), 0.05, GAINS)[0] == pytest.approx(0.3)


def test_blocked_way_is_left_to_the_navigator_for_a_while() -> None:
    follower = WaypointFollower()
    follower.follow([(5.0, 0.0)])
    assert follower.steer((0, 0, 0), (0.0, 1.0), 0.05, GAINS) == (0.0, 1.0)
    assert follower.steer((0, 0, 0), (0.6, 0.3), 0.05, GAINS) == (0.6, 0.3)
    follower.steer((0, 0, 0), (0.6, 0.3), DETOUR_S, GAINS)
    assert follower.steer((0, 0, 0), (0.6, 0.3), 0.05, GAINS) == (0.6, 0.0)
