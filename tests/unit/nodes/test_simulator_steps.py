"""The simulator makes its steps in groups: a run is the same as if each step were made at its own moment."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest
import rclpy
from bot_console_robot.simulation.simulation import STEP_NS
from bot_console_robot.simulator_node import MAX_STEPS_AHEAD, Simulator
from domains import unused_domain
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

MS = 1_000_000


class Robot:
    """A simulator whose steady clock is set by the test, in ms since it began."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.node: Any = Simulator()
        self._begin = self._now = self.node._origin
        clock = SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=self._now))
        monkeypatch.setattr(self.node, "_steady", clock)
        self.poses: list[int] = []
        monkeypatch.setattr(self.node._odometry, "publish", lambda message: self.poses.append(self.steps))

    @property
    def steps(self) -> int:
        return self.node._simulation.steps

    def at(self, ms: float) -> Any:
        self._now = self._begin + round(ms * MS)
        return self.node

    @property
    def next_tick(self) -> float:
        """When the timer is due, in ms since it began."""
        return (self._now - self._begin + self.node._timer.timer_period_ns) / MS


@pytest.fixture
def robot(monkeypatch: pytest.MonkeyPatch) -> Iterator[Robot]:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    rclpy.init()
    try:
        yield Robot(monkeypatch)
    finally:
        rclpy.shutdown()


def driving(linear: float, angular: float) -> Twist:
    command = Twist()
    command.linear.x, command.angular.z = linear, angular
    return command


def test_timer_is_due_at_the_next_pose_or_scan(robot: Robot) -> None:
    robot.at(10)._tick()
    assert (robot.steps, robot.next_tick) == (1, 50)
    robot.at(50.2)._tick()
    assert (robot.steps, robot.next_tick) == (5, 100), "counted from the beginning, so that it does not drift"
    robot.at(70)._on_command(driving(0.5, 0.0))
    robot.at(100)._tick()
    assert robot.next_tick == 150
    assert robot.poses == [5, 10]


def test_rates_determine_when_the_timer_is_due(robot: Robot) -> None:
    robot.node.set_parameters([Parameter("odom_rate", value=33.0), Parameter("scan_rate", value=1.0)])
    robot.at(10)._tick()
    assert robot.next_tick == 30
    robot.node.set_parameters([Parameter("odom_rate", value=1.0)])
    robot.at(30)._tick()
    assert robot.next_tick == 30 + 10 * MAX_STEPS_AHEAD, "a collision is reported in time"


@pytest.mark.parametrize(("topic", "kind"), [("/clock", Clock), ("bumper", Bool)])
def test_each_step_is_made_at_its_time_for_subscribers_of_time_and_bumper(robot: Robot, topic: str, kind: Any) -> None:
    subscription = robot.node.create_subscription(kind, topic, lambda message: None, 10)
    robot.at(10)._tick()
    assert robot.next_tick == 20
    robot.node.destroy_subscription(subscription)
    robot.at(20)._tick()
    assert robot.next_tick == 50


def test_steps_due_are_made_before_anything_changes(robot: Robot) -> None:
    robot.at(20)._on_command(driving(0.5, 0.0))
    assert robot.steps == 2
    robot.at(30).set_parameters([Parameter("drive.acceleration", value=0.5)])
    assert robot.steps == 3
    robot.at(40)._stop.stop("a test", "to see it")
    assert robot.steps == 4
    robot.at(50)._on_report(None, Trigger.Response())
    assert robot.steps == 5
    robot.at(60)._on_pose(PoseWithCovarianceStamped())
    assert robot.steps == 6
    robot.at(70)._on_pause(SetBool.Request(data=True), SetBool.Response())
    assert robot.steps == 7


def test_paused_simulation_has_no_timer_and_goes_on_from_its_resumption(robot: Robot) -> None:
    robot.at(10)._on_pause(SetBool.Request(data=True), SetBool.Response())
    assert robot.node._timer.is_canceled()
    robot.at(1000)._on_command(driving(0.5, 0.0))
    assert robot.steps == 1
    robot.at(2003)._on_pause(SetBool.Request(data=False), SetBool.Response())
    assert not robot.node._timer.is_canceled()
    assert robot.next_tick == 2043, "at step 5, the next pose"
    robot.at(2043)._tick()
    assert (robot.steps, robot.poses) == (5, [5])


COMMANDS = {15: (0.5, 0.3), 20: (0.8, -0.2), 37: (0.1, 1.0), 120: (0.6, 0.0), 121: (0.0, 0.0), 450: (1.0, 0.5)}


def digest_with_ticks_every(robot: Robot, period_ms: int) -> str:
    for ms in range(1, 1001):
        if ms % period_ms == 0:
            robot.at(ms)._tick()
        if ms in COMMANDS:
            robot.at(ms)._on_command(driving(*COMMANDS[ms]))
    assert robot.steps == 100
    return robot.node._simulation.report()["digest"]


def test_steps_in_groups_give_the_run_of_single_steps(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    assert STEP_NS == 10 * MS
    single = digest_with_ticks_every(robot, 10)
    robot.node.destroy_node()
    assert digest_with_ticks_every(Robot(monkeypatch), 50) == single
