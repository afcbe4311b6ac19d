"""A robot whose simulation lags is judged by its own time: late, but not broken."""

from __future__ import annotations

import itertools
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console_robot.common.robot_time import FAR_NS, RobotTime
from bot_console_robot.safety.scan_watch import ScanWatch
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan

SECOND = 1_000_000_000


class Rig:
    """A node on a graph with or without a simulator's clock, and a steady clock that is set by hand."""

    def __init__(self) -> None:
        self.wall = 50 * SECOND
        self.events: Any = None
        node: Any = SimpleNamespace(create_subscription=self._subscribe)
        steady: Any = SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=self.wall))
        self.time = RobotTime(node, steady)

    def _subscribe(self, *given: object, event_callbacks: object) -> object:
        self.events = event_callbacks
        return object()

    def clocks(self, count: int) -> None:
        """Set the number of clock publishers."""
        self.events.matched(SimpleNamespace(current_count=count))

    def clock(self, seconds: float) -> None:
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(round(seconds * SECOND), SECOND)
        self.time._on_clock(message)


@pytest.fixture
def rig() -> Rig:
    return Rig()


def test_robot_time_is_steady_until_asked_to_follow_a_clock(rig: Rig) -> None:
    began = rig.time.now()
    rig.wall += SECOND
    assert rig.time.now() - began == SECOND


def test_followed_clock_counts_only_simulated_seconds(rig: Rig) -> None:
    rig.time.follow(7 * SECOND)
    rig.clock(7.0)
    began = rig.time.now()
    rig.wall += 60 * SECOND
    rig.clock(7.3)
    assert rig.time.now() - began == 0.3 * SECOND


def test_reset_or_end_of_a_simulation_does_not_turn_time_back(rig: Rig) -> None:
    rig.time.follow(7 * SECOND)
    seen = []
    for seconds in (7.0, 7.5, 0.0, 0.2):
        rig.time.follow(round(seconds * SECOND))
        rig.clock(seconds)
        seen.append(rig.time.now())
    rig.clocks(0)
    seen.append(rig.time.now())
    rig.wall += SECOND
    seen.append(rig.time.now())
    assert [b - a for a, b in itertools.pairwise(seen)] == [0.5 * SECOND, 0, 0.2 * SECOND, 0, SECOND]


def test_clock_that_is_not_the_robots_is_not_followed(rig: Rig) -> None:
    rig.time.follow(7 * SECOND + 2 * FAR_NS)
    rig.clock(7.0)
    began = rig.time.now()
    rig.wall += SECOND
    assert rig.time.now() - began == SECOND


def test_without_simulation_scans_expire_by_steady_time() -> None:
    rig = Rig()
    watch = ScanWatch(rig.time.now, SECOND // 2)
    assert watch.take(LaserScan(angle_min=-1.0, angle_increment=0.1, ranges=[2.0] * 20)) and watch.fresh
    rig.wall += SECOND
    rig.time.follow(watch.stamp)
    assert not watch.fresh


def test_scan_of_a_lagging_simulation_stays_fresh_in_its_time(rig: Rig) -> None:
    watch = ScanWatch(rig.time.now, SECOND // 2)
    watch.take(LaserScan(angle_min=-1.0, angle_increment=0.1, ranges=[2.0] * 20))
    rig.wall += SECOND // 4
    rig.time.follow(watch.stamp)
    rig.clock(0.1)
    rig.wall += 10 * SECOND
    rig.clock(0.3)
    assert watch.fresh
    rig.clock(0.7)
    assert not watch.fresh


def test_clock_is_followed_while_scans_continue(rig: Rig) -> None:
    rig.time.follow(0)
    rig.clock(0.0)
    began = rig.time.now()
    for seconds in (4.0, 8.0, 12.0):
        rig.time.note_stamp(round(seconds * SECOND))
        rig.clock(seconds)
        rig.wall += 20 * SECOND
    assert rig.time.now() - began == 12 * SECOND, "a clock is compared with the newest scan, not with the first"


def test_robot_time_does_not_query_the_graph_under_load(rig: Rig) -> None:
    rig.time.follow(7 * SECOND)
    # The rig's node has no graph methods, for which it would have to follow the whole graph.
    rig.time.follow(8 * SECOND)
    rig.clock(8.0)
    began = rig.time.now()
    rig.clocks(2)
    rig.clocks(1)
    rig.clock(8.5)
    assert rig.time.now() - began == 0.5 * SECOND, "a remaining clock is still followed when another one leaves"
