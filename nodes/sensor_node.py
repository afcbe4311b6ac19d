#!/usr/bin/env python3
"""Node `sensor_handler`: publishes the filtered scan and the obstacles detected in it, at its own rate."""

from __future__ import annotations

from bot_console_robot.common.demand import has_receiver
from bot_console_robot.common.diagnostics import ERROR, OK
from bot_console_robot.common.health import Health, HealthReport
from bot_console_robot.common.parameters import number, plain, whole
from bot_console_robot.common.running import run
from bot_console_robot.common.scans import SCANS, intensities_of, packed, ranges_of
from bot_console_robot.detection import Detection, find, median_of_three, without_weak_returns
from geometry_msgs.msg import Pose, PoseArray
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan


class SensorHandler(Node):
    """Publishes `scan_filtered` and `detections` while they have subscribers."""

    def __init__(self) -> None:
        super().__init__("sensor_handler", enable_logger_service=True)
        self.declare_parameter("update_rate", 10.0, number("Rate of the filtered scan (Hz)", 0.5, 50.0))
        self.declare_parameter("filter_enabled", True, plain("Remove stray beams"))
        self.declare_parameter(
            "detection_threshold", 100, whole("Intensity from which a return counts as an obstacle (0-255)", 0, 255)
        )
        self.add_post_set_parameters_callback(self._apply)
        self._newest: LaserScan | None = None
        self._scans = self.create_publisher(LaserScan, "scan_filtered", 10)
        self._detections = self.create_publisher(PoseArray, "detections", 10)
        self.create_subscription(LaserScan, "scan", self._on_scan, SCANS)
        self._count = 0
        self._beams = (0, 0)
        self._health = HealthReport(self, "scan", self._poll)
        self._read()
        self._timer = self.create_timer(1.0 / self._rate, self._process)
        self.get_logger().info(f"Filtering scans at {self._rate} Hz")

    def _read(self) -> None:
        self._rate = float(self.get_parameter("update_rate").value)
        self._filter = bool(self.get_parameter("filter_enabled").value)
        self._threshold = int(self.get_parameter("detection_threshold").value)

    def _apply(self, changes: list[Parameter]) -> None:
        self._read()
        if any(change.name == "update_rate" for change in changes):
            self.destroy_timer(self._timer)
            self._timer = self.create_timer(1.0 / self._rate, self._process)
        for change in changes:
            self.get_logger().info(f"✓ {change.name}: {change.value}")

    def _on_scan(self, scan: LaserScan) -> None:
        self._newest = scan
        self._count += 1

    def _poll(self) -> Health:
        """Return the health: the number of scans in the last second."""
        count, self._count = self._count, 0
        beams, things = self._beams
        values = {"scans per second": count, "beams": beams, "things seen": things, "filtered": self._filter}
        return (OK, f"{count} scans per second", values) if count else (ERROR, "no scans received", values)

    def _process(self) -> None:
        scan, self._newest = self._newest, None
        if scan is None or not (
            self._health.has_receiver or has_receiver(self._scans) or has_receiver(self._detections)
        ):
            return
        ranges = without_weak_returns(ranges_of(scan), intensities_of(scan), self._threshold)
        if self._filter:
            ranges = median_of_three(ranges)
        found = find(ranges, scan.angle_min, scan.angle_increment)
        self._beams = (len(ranges), len(found))
        scan.ranges = packed(ranges)
        self._scans.publish(scan)
        self._detections.publish(PoseArray(header=scan.header, poses=[_pose(each) for each in found]))


def _pose(detection: Detection) -> Pose:
    pose = Pose()
    pose.position.x = detection.x
    pose.position.y = detection.y
    return pose


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(SensorHandler, args)


if __name__ == "__main__":
    main()
