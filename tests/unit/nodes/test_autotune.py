"""Tuning while driving: only while a safety monitor is alive, within the descriptor; reverted when it falls silent."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import rclpy
from bot_console.runtime.process import stepped
from bot_console_robot.common.diagnostics import OK, status
from bot_console_robot.common.parameters import number
from bot_console_robot.common.running import CannotStart
from diagnostic_msgs.msg import DiagnosticArray
from domains import unused_domain
from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import UInt32

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Bench:
    """A navigator that drives at full speed, a safety monitor that can fall silent, and the tuner; stepped."""

    def __init__(self, clock: object, monitor: bool = True) -> None:
        from bot_console_robot.autotune_node import AutoTune

        self.clock = clock
        self.watching, self.limited_by, self.collisions = monitor, "", 0
        self.robot = rclpy.create_node("robot_navigator")
        self.robot.declare_parameter("max_speed", 1.0, number("Fastest (m/s)", 0.1, 2.0))
        self.odometry = self.robot.create_publisher(Odometry, "odom", 10)
        self.diagnostics = self.robot.create_publisher(DiagnosticArray, "diagnostics", 10)
        self.bumps = self.robot.create_publisher(UInt32, "collisions", LATCHED)
        self.robot.create_timer(0.1, self._drive, clock=Clock(clock_type=ClockType.STEADY_TIME))
        self.tuner = AutoTune()
        self.executor = SingleThreadedExecutor()
        for node in (self.robot, self.tuner):
            self.executor.add_node(node)

    @property
    def speed(self) -> float:
        return float(self.robot.get_parameter("max_speed").value)

    def _drive(self) -> None:
        odometry = Odometry()
        odometry.twist.twist.linear.x = self.speed
        self.odometry.publish(odometry)
        self.bumps.publish(UInt32(data=self.collisions))
        if self.watching:
            values = {"limited_by": self.limited_by}
            stamp = self.robot.get_clock().now().to_msg()
            self.diagnostics.publish(status("safety_monitor: velocity", OK, "free", values, stamp))

    def drive(self, seconds: float) -> list[float]:
        """The values of the parameter, sampled twice a second."""
        seen = []
        for _ in range(round(seconds * 2)):
            end = self.clock.steady_ns() + 500_000_000
            while (left := end - self.clock.steady_ns()) > 0:
                self.executor.spin_once(timeout_sec=left * 1e-9)
            seen.append(self.speed)
        return seen


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Iterator[object]:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    with stepped(virtual_main=True) as made:
        rclpy.init(args=[])
        yield made
        rclpy.try_shutdown()


def test_tuner_approaches_the_better_value_within_the_descriptor(clock: object) -> None:
    seen = Bench(clock).drive(400)
    assert max(seen) > 1.7
    assert max(seen) <= 2.0


def test_nothing_changes_without_a_safety_monitor(clock: object) -> None:
    assert set(Bench(clock, monitor=False).drive(60)) == {1.0}


def test_value_is_reverted_when_the_monitor_falls_silent(clock: object) -> None:
    bench = Bench(clock)
    bench.drive(60)
    assert bench.speed > 1.0
    bench.watching = False
    assert bench.drive(3)[-1] == 1.0
    assert set(bench.drive(30)) == {1.0}
    bench.watching = True
    bench.drive(30)
    assert bench.speed > 1.0


def test_nothing_is_tuned_while_the_robot_is_stopped(clock: object) -> None:
    bench = Bench(clock)
    bench.limited_by = "emergency stop"
    assert set(bench.drive(60)) == {1.0}


def test_collision_limits_the_range(clock: object) -> None:
    bench = Bench(clock)
    while bench.speed < 1.15:
        bench.drive(1)
    high = bench.speed
    bench.collisions += 1
    assert bench.drive(2)[-1] < high
    assert max(bench.drive(200)) < high


def test_tuner_continues_from_a_value_set_by_a_person(clock: object) -> None:
    bench = Bench(clock)
    bench.drive(30)
    bench.robot.set_parameters([Parameter("max_speed", value=0.5)])
    assert max(bench.drive(15)) < 0.7


def test_safety_monitor_cannot_be_tuned(clock: object, monkeypatch: pytest.MonkeyPatch) -> None:
    from bot_console_robot.autotune_node import AutoTune

    rclpy.shutdown()
    rclpy.init(args=["--ros-args", "-p", "target_node:=/safety_monitor", "-p", "target_parameter:=warning_distance"])
    with pytest.raises(CannotStart, match="keep the robot safe"):
        AutoTune()
