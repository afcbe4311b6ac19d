"""A node's own rules are checked without setting anything."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import rclpy
from bot_console_robot.safety_node import SafetyMonitor
from domains import unused_domain
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter

TIMEOUT_S = 240.0


@pytest.fixture
def monitor(monkeypatch: pytest.MonkeyPatch) -> Iterator[SafetyMonitor]:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    rclpy.init(args=[])
    yield SafetyMonitor()
    rclpy.shutdown()


@pytest.mark.parametrize(
    ("values", "refused"),
    [
        ({"warning_distance": 0.5}, ""),
        ({"warning_distance": 0.2}, "must be greater than emergency_stop_distance"),
        ({"warning_distance": 0.2, "emergency_stop_distance": 0.1}, ""),
        ({"warning_distance": "far"}, "another type"),
        ({"distance": 0.2}, "undeclared"),
    ],
)
def test_rule_answers_without_setting_the_value(
    monitor: SafetyMonitor, values: dict[str, object], refused: str
) -> None:
    requester = rclpy.create_node("asker")
    executor = SingleThreadedExecutor()
    executor.add_node(monitor)
    executor.add_node(requester)
    client = requester.create_client(SetParametersAtomically, "/safety_monitor/check_parameters")
    asked = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
    future = client.call_async(SetParametersAtomically.Request(parameters=asked))
    executor.spin_until_future_complete(future, TIMEOUT_S)
    answer = future.result()
    assert answer is not None
    assert answer.result.successful is not bool(refused) and refused in answer.result.reason
    assert monitor.get_parameter("warning_distance").value == 0.7
