#!/usr/bin/env python3
"""Node `telemetry_publisher`: publishes values that are worth plotting, at its own rate."""

from __future__ import annotations

from bot_console_robot.common.diagnostics import OK, WARN, status
from bot_console_robot.common.parameters import number, plain
from bot_console_robot.common.running import run
from bot_console_robot.common.scans import SCANS, nearest_return
from bot_console_robot.trip_computer import Trip
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64, UInt32

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class TelemetryPublisher(Node):
    """Publishes `telemetry/...`, and a summary on `diagnostics` while `include_diagnostics` is true."""

    def __init__(self) -> None:
        super().__init__("telemetry_publisher", enable_logger_service=True)
        self.declare_parameter("publish_rate", 1.0, number("Rate of the telemetry topics (Hz)", 0.1, 50.0))
        self.declare_parameter("include_diagnostics", True, plain("Publish a summary on the topic diagnostics"))
        self.add_post_set_parameters_callback(self._apply)
        self._trip = Trip()
        self._nearest: float | None = None
        self._scan: LaserScan | None = None
        self._collisions = 0
        self._figures = {
            name: self.create_publisher(Float64, f"telemetry/{name}", 10)
            for name in ("speed", "distance", "nearest_obstacle")
        }
        self._counts = {
            name: self.create_publisher(UInt32, f"telemetry/{name}", 10) for name in ("stops", "collisions")
        }
        self._diagnostics = self.create_publisher(DiagnosticArray, "diagnostics", 10)
        self.create_subscription(Odometry, "odom", self._on_odometry, 10)
        self.create_subscription(LaserScan, "scan", self._on_scan, SCANS)
        self.create_subscription(UInt32, "collisions", self._on_collisions, LATCHED)
        self._start_timer()

    def _start_timer(self) -> None:
        rate = float(self.get_parameter("publish_rate").value)
        self._timer = self.create_timer(1.0 / rate, self._publish)
        self.get_logger().info(f"Publishing telemetry at {rate} Hz")

    def _apply(self, changes: list[Parameter]) -> None:
        for change in changes:
            if change.name == "publish_rate":
                self.destroy_timer(self._timer)
                self._start_timer()
            else:
                self.get_logger().info(f"✓ {change.name}: {change.value}")

    def _on_odometry(self, message: Odometry) -> None:
        stamp = message.header.stamp
        self._trip.update(stamp.sec + stamp.nanosec * 1e-9, message.twist.twist.linear.x)

    def _on_scan(self, scan: LaserScan) -> None:
        self._scan = scan  # Evaluated only when published: scans arrive ten times as often.

    def _on_collisions(self, message: UInt32) -> None:
        self._collisions = message.data

    def _publish(self) -> None:
        trip, scan = self._trip, self._scan
        if scan is not None:
            self._nearest, self._scan = nearest_return(scan), None
        figures = {"speed": trip.speed, "distance": trip.distance, "nearest_obstacle": self._nearest}
        for name, value in figures.items():
            if value is not None:
                self._figures[name].publish(Float64(data=value))
        counts = {"stops": trip.stops, "collisions": self._collisions}
        for name, count in counts.items():
            self._counts[name].publish(UInt32(data=count))
        if self.get_parameter("include_diagnostics").value:
            self._publish_diagnostics({**figures, **counts})

    def _publish_diagnostics(self, values: dict[str, float | int | None]) -> None:
        known = {name: value for name, value in values.items() if value is not None}
        level, text = (OK, "no collisions") if not self._collisions else (WARN, f"{self._collisions} collisions")
        stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(status("telemetry_publisher: trip", level, text, known, stamp))


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(TelemetryPublisher, args)


if __name__ == "__main__":
    main()
