"""A monitor of a bus receives all its messages without being visible."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from bot_console.runtime.rmw.middleware import bus_of
from bot_console_robot.common.demand import has_receiver
from rclpy.executors import SingleThreadedExecutor
from rclpy.serialization import deserialize_message
from std_msgs.msg import String


@pytest.fixture
def carried_messages() -> Iterator[list[Any]]:
    """The messages carried on `/words`."""
    found: list[Any] = []

    def hear(by: Any, source: bytes, number: int, sent: int, message: Any) -> None:
        if by.topic == "/words":
            found.append((number, message))

    bus_of(0).monitor(hear)
    yield found
    bus_of(0).monitor(None)


def test_monitor_receives_unsubscribed_messages_and_is_not_counted(node: Any, carried_messages: list[Any]) -> None:
    publisher = node.create_publisher(String, "/words", 10)
    publisher.publish(String(data="to nobody"))
    assert [(number, each.data) for number, each in carried_messages] == [(1, "to nobody")]
    assert publisher.get_subscription_count() == node.count_subscribers("/words") == 0
    assert has_receiver(publisher)
    bus_of(0).monitor(None)
    assert not has_receiver(publisher)
    publisher.publish(String(data="again"))
    assert len(carried_messages) == 1


def test_monitor_does_not_see_changes_by_a_subscription(node: Any, carried_messages: list[Any]) -> None:
    def spoil(message: Any) -> None:
        message.data = "spoilt"

    node.create_subscription(String, "/words", spoil, 10)
    node.create_publisher(String, "/words", 10).publish(String(data="as it was"))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin_once(timeout_sec=1.0)
    executor.remove_node(node)
    assert [each.data for _, each in carried_messages] == ["as it was"]


def test_serialized_message_is_not_serialized_again(node: Any, carried_messages: list[Any]) -> None:
    node.create_subscription(String, "/words", lambda data: None, 10, raw=True)
    node.create_publisher(String, "/words", 10).publish(String(data="bytes"))
    ((_, data),) = carried_messages
    assert deserialize_message(data, String).data == "bytes"
