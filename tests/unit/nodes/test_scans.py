"""Scans of a real LIDAR, whose driver offers best effort, reach every node that subscribes to them."""

from collections.abc import Callable, Iterator

import pytest
import rclpy
from bot_console_robot.navigation_node import Navigator
from bot_console_robot.robot_node import RobotNavigator
from bot_console_robot.safety_node import SafetyMonitor
from bot_console_robot.sensor_node import SensorHandler
from bot_console_robot.telemetry_node import TelemetryPublisher
from domains import unused_domain
from rclpy.node import Node
from rclpy.qos import QoSCompatibility, qos_check_compatible, qos_profile_sensor_data, qos_profile_system_default


@pytest.fixture(autouse=True)
def ros() -> Iterator[None]:
    rclpy.init(args=["test"], domain_id=unused_domain())
    yield
    rclpy.try_shutdown()


@pytest.mark.parametrize("kind", [Navigator, RobotNavigator, SafetyMonitor, SensorHandler, TelemetryPublisher])
def test_best_effort_scans_are_received(kind: Callable[[], Node]) -> None:
    node = kind()
    asked = [each.qos_profile for each in node.subscriptions if each.topic_name == "/scan"]
    offered = (qos_profile_sensor_data, qos_profile_system_default)
    fits = [qos_check_compatible(offer, each)[0] for each in asked for offer in offered]
    node.destroy_node()
    assert fits and QoSCompatibility.ERROR not in fits
