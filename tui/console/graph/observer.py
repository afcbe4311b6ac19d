"""The node that reads the graph; it is replaced when its middleware no longer knows the names of existing nodes.

With Fast DDS, a process sends the names of its nodes in a message once. If the process was lost for longer than its
lease, because it was suspended or its link was down, it is discovered again, but participants that have received that
message before do not get it again, and its endpoints stay without a node. A new participant gets it at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import rclpy
from bot_console.tui.console.own_context import WITHOUT_LOG_FILE
from rclpy.context import Context
from rclpy.node import Node

if TYPE_CHECKING:
    from rclpy.topic_endpoint_info import TopicEndpointInfo

NAME = "_bot_console_graph"
UNNAMED = "_NODE_NAME_UNKNOWN_"
"""The node name that rmw gives to an endpoint whose node it does not know."""
TOPIC = "/parameter_events"
"""A topic to which every node publishes."""
UNNAMED_POLLS = 4
"""Consecutive polls with unnamed endpoints after which a new node is tried: endpoints are found before their names."""
DISCOVERY_POLLS = 10
"""Polls after which the new node is used even if it has not found all nodes that the old one knows."""


class Observer:
    """Provides `node`, which reads the graph. The executor's thread has to call `poll` regularly."""

    def __init__(self, node: Node, make: Callable[[Node], tuple[Node, Callable[[], None]]] | None = None) -> None:
        """`make` returns another node like the given one, and a function that destroys it."""
        self.node = node
        self._first = node
        self._make = make or _new_participant
        self._end: Callable[[], None] = _do_nothing
        self._next: tuple[Node, Callable[[], None]] | None = None
        self._polls = 0
        self._nameless = 0
        """The number of unnamed endpoints that a new node does not name either, because they belong to no ROS node."""

    def poll(self) -> None:
        """Count unnamed endpoints; if some stay, create a new node and switch to it."""
        if self._next is not None:
            self._poll_next(*self._next)
            return
        unnamed = _unnamed(self.node)
        self._nameless = min(self._nameless, unnamed)
        self._polls = self._polls + 1 if unnamed > self._nameless else 0
        if self._polls >= UNNAMED_POLLS:
            self._next, self._polls = self._make(self._first), 0

    def _poll_next(self, node: Node, end: Callable[[], None]) -> None:
        self._polls += 1
        missing = set(self.node.get_node_names()) - set(node.get_node_names())
        if (missing or _unnamed(node)) and self._polls < DISCOVERY_POLLS:
            return
        self._end()
        self.node, self._end = node, end
        self._next, self._polls, self._nameless = None, 0, _unnamed(node)

    def get_publishers_info_by_topic(self, topic: str) -> Sequence[TopicEndpointInfo]:
        """The publishers of a topic."""
        return self.node.get_publishers_info_by_topic(topic)

    def get_subscriptions_info_by_topic(self, topic: str) -> Sequence[TopicEndpointInfo]:
        """The subscriptions of a topic."""
        return self.node.get_subscriptions_info_by_topic(topic)

    def close(self) -> None:
        """Destroy the nodes created here."""
        self._end()
        if self._next is not None:
            self._next[1]()


def _unnamed(node: Node) -> int:
    return sum(each.node_name == UNNAMED for each in node.get_publishers_info_by_topic(TOPIC))


def _new_participant(like: Node) -> tuple[Node, Callable[[], None]]:
    """Create a node with its own context, and so its own participant."""
    context = Context()
    rclpy.init(args=WITHOUT_LOG_FILE, context=context, domain_id=like.context.get_domain_id())
    node = rclpy.create_node(
        NAME, context=context, use_global_arguments=False, enable_rosout=False, start_parameter_services=False
    )

    def end() -> None:
        node.destroy_node()
        context.try_shutdown()

    return node, end


def _do_nothing() -> None:
    """Stand-in for destroying a node that was not created here."""
