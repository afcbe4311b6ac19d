"""Telemetry is computed from the newest messages."""

from __future__ import annotations

from array import array

import pytest
import rclpy
from bot_console_robot.telemetry_node import TelemetryPublisher
from domains import unused_domain
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64


def scan(*ranges: float) -> LaserScan:
    return LaserScan(range_min=0.1, range_max=8.0, ranges=array("f", ranges))


def test_nearest_obstacle_is_that_of_the_newest_scan(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    rclpy.init()
    try:
        node, reported = TelemetryPublisher(), list[float]()
        node.create_subscription(
            Float64, "telemetry/nearest_obstacle", lambda message: reported.append(message.data), 10
        )
        for ranges in ((4.0, 2.0), (3.0, 0.05)):
            node._on_scan(scan(*ranges))
        node._publish()
        node._publish()
        node._on_scan(scan(float("inf"), 1.5))
        node._publish()
        while len(reported) < 3:
            rclpy.spin_once(node)
        assert reported == pytest.approx([3.0, 3.0, 1.5])
    finally:
        rclpy.shutdown()
