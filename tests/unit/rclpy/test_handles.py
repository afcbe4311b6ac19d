"""Handles of entities: `with` uses them, and messages can be taken manually."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.exceptions import InvalidHandle
from rclpy.serialization import deserialize_message
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

MAKERS = {
    "publisher": lambda node: node.create_publisher(Int32, "t", 10),
    "subscription": lambda node: node.create_subscription(Int32, "t", lambda message: None, 10),
    "service": lambda node: node.create_service(Trigger, "s", lambda request, response: response),
    "client": lambda node: node.create_client(Trigger, "s"),
    "guard_condition": lambda node: node.create_guard_condition(lambda: None),
    "timer": lambda node: node.create_timer(1.0, lambda: None),
}


@pytest.mark.parametrize("kind", MAKERS)
def test_entity_outlives_a_with_block(ros: Any, kind: str) -> None:
    node = ros.node()
    entity, other = MAKERS[kind](node), MAKERS[kind](node)
    with entity.handle as nothing:
        assert nothing is None
        assert entity.handle == entity.handle != other.handle
        assert entity.handle.pointer != other.handle.pointer
    with entity.handle:
        pass
    assert getattr(node, f"destroy_{kind}")(entity)
    with pytest.raises(InvalidHandle), entity.handle:
        pass


def test_node_and_context_outlive_a_with_block(ros: Any) -> None:
    node = ros.node("lives")
    with node.handle:
        pass
    with node.context.handle:
        pass
    assert (node.get_name(), node.context.ok()) == ("lives", True)


def test_messages_can_be_taken_manually(ros: Any) -> None:
    node = ros.node()
    subscription = node.create_subscription(Int32, "t", lambda message: None, 10)
    publisher = node.create_publisher(Int32, "t", 10)
    for number in (1, 2):
        publisher.publish(Int32(data=number))
    message, info = subscription.handle.take_message(Int32, False)
    assert (message.data, sorted(info)) == (
        1,
        ["publication_sequence_number", "received_timestamp", "reception_sequence_number", "source_timestamp"],
    )
    data, _ = subscription.handle.take_message(Int32, True)
    assert deserialize_message(data, Int32).data == 2
    assert subscription.handle.take_message(Int32, False) is None
