"""Attributes and methods that a program's node has in addition to those of rclpy."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Int32

NAMES = [
    "_attach",
    "_bus",
    "_commit",
    "_declare",
    "_destroy",
    "_detach",
    "_enter",
    "_entities",
    "_executor",
    "_group",
    "_id",
    "_name",
    "_namespace",
    "_of",
    "_order",
    "_profile",
    "_publishers",
    "_rates",
    "_rosout",
    "_sink",
    "_store",
    "_use",
    "_waitables",
    "destroyed",
]


class NodeWithAttributes(Node):
    """Sets arbitrary attributes before calling the base class."""

    def __init__(self, **options: Any) -> None:
        super().__init__("crowded", **options)
        for name in NAMES:
            setattr(self, name, f"mine: {name}")
        self.declare_parameter("p", 1)
        self.heard: list[int] = []
        self.create_subscription(Int32, "t", lambda message: self.heard.append(message.data), 10)
        self.publisher = self.create_publisher(Int32, "t", 10)


def test_own_attributes_do_not_interfere_with_the_node(ros: Any) -> None:
    from rclpy.executors import SingleThreadedExecutor

    node = NodeWithAttributes(context=ros.init())
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    node.publisher.publish(Int32(data=4))
    executor.spin_once(timeout_sec=5)
    assert node.heard == [4]
    assert node.set_parameters([Parameter("p", value=2)])[0].successful
    assert (node.get_name(), node.get_namespace(), node.executor) == ("crowded", "/", executor)
    assert [getattr(node, name) for name in NAMES] == [f"mine: {name}" for name in NAMES]
    node.destroy_node()
    assert ros.node("other").get_node_names() == ["other"]


def test_context_cannot_be_set(ros: Any) -> None:
    with pytest.raises(AttributeError):
        ros.node().context = "mine"
