"""A message for raw subscriptions only is serialized when it is published, and not copied."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.runtime.rosidl.conversion import FieldTypeError
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message
from std_msgs.msg import String

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture
def copies(monkeypatch: pytest.MonkeyPatch) -> list[String]:
    """The messages that were copied."""
    copied: list[String] = []
    copy = String._copy_

    def counted(message: String) -> String:
        copied.append(message)
        return copy(message)

    monkeypatch.setattr(String, "_copy_", counted)
    return copied


def received(node: Any, got: list[Any], count: int) -> None:
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while len(got) < count:
        executor.spin_once(timeout_sec=10.0)


def test_message_for_raw_subscriptions_is_not_copied_and_later_changes_are_unseen(
    node: Any, copies: list[String]
) -> None:
    got: list[bytes] = []
    for _ in range(2):
        node.create_subscription(String, "/words", got.append, 10, raw=True)
    publisher = node.create_publisher(String, "/words", 10)
    message = String(data="as it was")
    publisher.publish(message)
    message.data = "changed"
    received(node, got, 2)
    assert [deserialize_message(each, String).data for each in got] == ["as it was"] * 2
    assert not copies


def test_message_is_copied_for_an_ordinary_subscription(node: Any, copies: list[String]) -> None:
    got: list[Any] = []
    node.create_subscription(String, "/words", got.append, 10, raw=True)
    publisher = node.create_publisher(String, "/words", 10)
    subscription = node.create_subscription(String, "/words", got.append, 10)
    message = String(data="as it was")
    publisher.publish(message)
    message.data = "changed"
    received(node, got, 2)
    assert [each.data for each in got if isinstance(each, String)] == ["as it was"]
    assert copies
    copies.clear()
    node.destroy_subscription(subscription)
    publisher.publish(message)
    assert not copies


def test_latched_message_is_copied(node: Any, copies: list[String]) -> None:
    got: list[bytes] = []
    node.create_subscription(String, "/words", got.append, LATCHED, raw=True)
    publisher = node.create_publisher(String, "/words", LATCHED)
    message = String(data="as it was")
    publisher.publish(message)
    message.data = "changed"
    node.create_subscription(String, "/words", got.append, LATCHED, raw=True)
    received(node, got, 2)
    assert [deserialize_message(each, String).data for each in got] == ["as it was"] * 2


def test_invalid_message_is_rejected_and_not_counted(node: Any) -> None:
    got: list[bytes] = []
    node.create_subscription(String, "/words", got.append, 10, raw=True)
    publisher = node.create_publisher(String, "/words", 10)
    with pytest.raises(FieldTypeError, match="field 'data' of std_msgs/msg/String must be a string"):
        publisher.publish(String(data=1))  # type: ignore[arg-type] -- what is refused
    publisher.publish(String(data="right"))
    received(node, got, 1)
    assert publisher._endpoint.published == 1
