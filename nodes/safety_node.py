#!/usr/bin/env python3
"""Node `safety_monitor`: the only node that commands the robot. It selects a source, limits its speed, and stops."""

from __future__ import annotations

import math
from collections.abc import Callable

from bot_console_robot.common.checking import offer_check
from bot_console_robot.common.demand import has_receiver
from bot_console_robot.common.diagnostics import ERROR, OK, WARN, status
from bot_console_robot.common.parameters import accepted, number, plain, proposed, refused
from bot_console_robot.common.robot_time import RobotTime
from bot_console_robot.common.running import CannotStart, run
from bot_console_robot.common.scans import SCANS
from bot_console_robot.safety.age_limits import LATE_NS, MAX_AGE_NS
from bot_console_robot.safety.arbitration import Arbiter, Command, Verdict, limit
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, STOP_FILE, EmergencyStop, declare_stop_file
from bot_console_robot.safety.scan_watch import ScanWatch
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan

TELEOP, NAVIGATION = "cmd_vel_teleop", "cmd_vel_nav"
WATCH_PERIOD_S = 0.1
"""Seconds between two checks for commands and scans that are too old."""
MAX_ZEROS = 10
"""Number of zero commands that are sent after the last source has expired."""
NO_COMMAND = "no fresh command"
NO_SCAN = "no fresh scan"
LOCKED = "emergency stop"
STEERED = "the person who steers"


class SafetyMonitor(Node):
    """Publishes `cmd_vel`, and `diagnostics` with the requested command, its limit and the result.

    While the emergency stop is locked it keeps publishing zero. While a person holds the steering only that person's
    commands count.
    """

    def __init__(self) -> None:
        super().__init__("safety_monitor", enable_logger_service=True)
        self._declare()
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._robot_time = RobotTime(self, self._steady)
        self._arbiter = Arbiter({TELEOP: self._now, NAVIGATION: self._robot_time.now}, MAX_AGE_NS)
        self._scan = ScanWatch(self._robot_time.now, MAX_AGE_NS)
        self._verdict = Verdict("", (0.0, 0.0), (0.0, 0.0), NO_COMMAND, math.inf)
        self._zeros = 0
        self._commands = self.create_publisher(Twist, "cmd_vel", 10)
        self._diagnostics = self.create_publisher(DiagnosticArray, "diagnostics", 10)
        for topic in (TELEOP, NAVIGATION):
            self.create_subscription(Twist, topic, self._listener(topic), 10)
        self.create_subscription(LaserScan, "scan", self._on_scan, SCANS)
        locked = "its parameter start_locked is true" if self._start_locked else ""
        stop_file = str(self.get_parameter(STOP_FILE).value)
        self._stop = EmergencyStop(self, self._steady, ARBITER, BASE, self._decide, locked=locked, stop_file=stop_file)
        self.create_timer(WATCH_PERIOD_S, self._watch, clock=self._steady)
        self.get_logger().info(f"Watching: slower from {self._warning} m, stop at {self._emergency} m")

    def _declare(self) -> None:
        self.declare_parameter(
            "emergency_stop_distance", 0.3, number("Stop when an obstacle is closer than this (m)", 0.05, 2.0)
        )
        self.declare_parameter("warning_distance", 0.7, number("Slow down below this distance (m)", 0.1, 5.0))
        self.declare_parameter("start_locked", False, plain("Start with the emergency stop on"))
        declare_stop_file(self)
        self.add_on_set_parameters_callback(self._check)
        offer_check(self, self._check)
        self.add_post_set_parameters_callback(self._apply)
        self._read()
        problem = _problem(self._emergency, self._warning)
        if problem:
            raise CannotStart(problem)

    def _read(self) -> None:
        self._emergency = float(self.get_parameter("emergency_stop_distance").value)
        self._warning = float(self.get_parameter("warning_distance").value)
        self._start_locked = bool(self.get_parameter("start_locked").value)

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        emergency, warning = proposed(self, changes, "emergency_stop_distance", "warning_distance")
        problem = _problem(emergency, warning)
        return refused(problem) if problem else accepted()

    def _apply(self, changes: list[Parameter]) -> None:
        self._read()
        for change in changes:
            unit = "" if change.name == "start_locked" else " m"
            self.get_logger().info(f"✓ {change.name}: {change.value}{unit}")

    def _listener(self, source: str) -> Callable[[Twist], None]:
        def on_command(message: Twist) -> None:
            self._arbiter.offer(source, message.linear.x, message.angular.z)
            self._decide()

        return on_command

    def _on_scan(self, scan: LaserScan) -> None:
        self._scan.take(scan)
        self._robot_time.note_stamp(self._scan.stamp)
        if self._verdict.final[0] > 0.0:
            self._decide()

    def _now(self) -> int:
        return self._steady.now().nanoseconds

    def _choose(self) -> Command | None:
        return self._arbiter.choose(*((NAVIGATION,) if self._stop.steered_by else ()))

    def _watch(self) -> None:
        if LATE_NS < self._scan.age < math.inf:  # before the first scan, the robot does not drive
            self._robot_time.follow(self._scan.stamp)
        if self._stop.lock.held or self._choose() is None or self._verdict.limited_by == NO_SCAN:
            self._decide()
        self._publish_diagnostics()

    def _decide(self) -> None:
        verdict = self._judge()
        driven = bool(verdict.source) or verdict.limited_by == LOCKED
        self._zeros = 0 if driven else self._zeros + 1
        changed = (verdict.source, verdict.limited_by) != (self._verdict.source, self._verdict.limited_by)
        self._verdict = verdict
        if self._zeros <= MAX_ZEROS:
            self._command(verdict)
        if changed:
            self._report(verdict)
            self._publish_diagnostics()

    def _judge(self) -> Verdict:
        command, nearest = self._choose(), self._scan.nearest
        asked = (command.linear, command.angular) if command else (0.0, 0.0)
        source = command.source if command else ""
        if self._stop.lock.held:
            return Verdict(source, asked, (0.0, 0.0), LOCKED, nearest)
        if command is None:
            return Verdict("", asked, (0.0, 0.0), STEERED if self._stop.steered_by else NO_COMMAND, nearest)
        if not self._scan.fresh:
            return Verdict(source, asked, (0.0, 0.0), NO_SCAN, math.inf)
        return limit(command, nearest, self._emergency, self._warning)

    def _command(self, verdict: Verdict) -> None:
        command = Twist()
        command.linear.x, command.angular.z = verdict.final
        self._commands.publish(command)

    def _report(self, verdict: Verdict) -> None:
        log = self.get_logger()
        if verdict.limited_by == "emergency_stop_distance":
            log.warning(f"⚠ Stopped: obstacle at {verdict.nearest:.2f} m, nearer than {self._emergency} m")
        elif verdict.limited_by == "warning_distance":
            log.warning(f"⚠ Slower: obstacle at {verdict.nearest:.2f} m", throttle_duration_sec=2.0)
        elif verdict.limited_by == NO_SCAN:
            log.error("Stopped: no usable scan for 0.5 s, so nobody sees what is ahead. Is the LIDAR running?")
        elif verdict.limited_by == NO_COMMAND:
            log.warning("Stopped: no velocity command for 0.5 s")

    def _publish_diagnostics(self) -> None:
        if not has_receiver(self._diagnostics):
            return
        verdict = self._verdict
        level = {"": OK, "warning_distance": WARN, NO_COMMAND: WARN, STEERED: OK}.get(verdict.limited_by, ERROR)
        message = f"limited by {verdict.limited_by}" if verdict.limited_by else "free"
        values = {
            "source": verdict.source,
            "asked.linear": verdict.asked[0],
            "asked.angular": verdict.asked[1],
            "limited_by": verdict.limited_by,
            "final.linear": verdict.final[0],
            "final.angular": verdict.final[1],
            "nearest": verdict.nearest,
        }
        stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(status("safety_monitor: velocity", level, message, values, stamp))


def _problem(emergency: float, warning: float) -> str:
    """What is wrong with the two distances (m); empty if they are consistent."""
    if warning > emergency:
        return ""
    return f"warning_distance ({warning} m) must be greater than emergency_stop_distance ({emergency} m)"


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(SafetyMonitor, args)


if __name__ == "__main__":
    main()
