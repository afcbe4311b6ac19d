#!/usr/bin/env python3
"""Node `robot_navigator`: drives towards free space; changes to its six parameters take effect at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bot_console_robot.avoidance import Avoidance, Rules
from bot_console_robot.common.checking import offer_check
from bot_console_robot.common.parameters import accepted, number, plain, refused, whole
from bot_console_robot.common.running import run
from bot_console_robot.common.scans import SCANS, intensities_of, ranges_of
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan

REPORT_INTERVAL_S = 1.0
"""Minimum interval, in s, between two reports of a blocked way."""


class RobotNavigator(Node):
    """Converts scans to velocity commands."""

    def __init__(self) -> None:
        super().__init__("robot_navigator", enable_logger_service=True)
        self.declare_parameter("max_speed", 1.0, number("Maximum linear velocity (m/s)", 0.1, 5.0))
        self.declare_parameter("safety_distance", 0.5, number("Minimum obstacle clearance (m)", 0.1, 2.0))
        self.declare_parameter(
            "detection_threshold", 100, whole("Intensity from which a return counts as an obstacle (0-255)", 0, 255)
        )
        self.declare_parameter("turn_rate", 1.0, number("Maximum angular velocity (rad/s)", 0.1, 3.0))
        self.declare_parameter("enable_safety", True, plain("Slow down and stop for obstacles"))
        self.declare_parameter("robot_name", "IntelligentRobot", plain("Robot identifier"))
        self.add_on_set_parameters_callback(self._check)
        offer_check(self, self._check)
        self.add_post_set_parameters_callback(self._apply)
        self._avoidance = Avoidance()
        self._rules = self._read_rules()
        self._name = str(self.get_parameter("robot_name").value)
        self._was_blocked = False
        self._commands = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self._on_scan, SCANS)
        self.create_timer(1.0, self._report)
        self._introduce()

    def _introduce(self) -> None:
        log, rules = self.get_logger(), self._rules
        log.info(f"🤖 {self._name} initialized!")
        log.info(f" Max Speed: {rules.max_speed} m/s")
        log.info(f" Safety Distance: {rules.safety_distance} m")
        log.info(f" Safety: {'ENABLED' if rules.enable_safety else 'DISABLED'}")

    def _read_rules(self) -> Rules:
        value: Callable[[str], Any] = lambda name: self.get_parameter(name).value  # noqa: E731 -- short for five reads
        return Rules(
            float(value("max_speed")),
            float(value("safety_distance")),
            int(value("detection_threshold")),
            float(value("turn_rate")),
            bool(value("enable_safety")),
        )

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        for change in changes:
            if change.name == "robot_name" and not str(change.value).strip():
                return refused("Robot name cannot be empty")
        return accepted()

    def _apply(self, changes: list[Parameter]) -> None:
        self._rules = self._read_rules()
        self._name = str(self.get_parameter("robot_name").value)
        log = self.get_logger()
        units = {
            "max_speed": ("Max speed", " m/s"),
            "safety_distance": ("Safety distance", " m"),
            "detection_threshold": ("Threshold", ""),
            "turn_rate": ("Turn rate", " rad/s"),
            "robot_name": ("Name", ""),
        }
        for change in changes:
            if change.name in units:
                label, unit = units[change.name]
                log.info(f"✓ {label}: {change.value}{unit}")
            elif change.name == "enable_safety":
                log.warning(f"⚠ Safety {'ENABLED' if change.value else 'DISABLED'}")

    def _on_scan(self, scan: LaserScan) -> None:
        decision = self._avoidance.decide(
            ranges_of(scan), intensities_of(scan), scan.angle_min, scan.angle_increment, self._rules
        )
        if decision.blocked and not self._was_blocked:
            self.get_logger().warning(
                f"⚠ Obstacle at {decision.nearest:.2f}m - Turning!", throttle_duration_sec=REPORT_INTERVAL_S
            )
        self._was_blocked = decision.blocked
        command = Twist()
        command.linear.x = decision.linear
        command.angular.z = decision.angular
        self._commands.publish(command)

    def _report(self) -> None:
        safety = "🛡️ SAFE" if self._rules.enable_safety else "⚡ PERFORMANCE"
        self.get_logger().info(f"[{self._name}] {safety} | Speed: {self._rules.max_speed} m/s")


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(RobotNavigator, args)


if __name__ == "__main__":
    main()
