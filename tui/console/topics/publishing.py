"""Publishes messages for a user, once or repeatedly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.topics.forms import filled, stamp
from bot_console.tui.console.topics.port import Payload, Repeated, Values
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

MAX_RATE_HZ = 1000.0
"""The highest rate (Hz) at which a message can be published."""
MATCH_POLL_S = 0.05
"""Seconds between two checks whether a new publisher has discovered its subscriptions."""
MAX_MATCH_POLLS = 20


@dataclass
class _RepeatedMessage:
    """A message that is published at a rate."""

    timer: Any
    type: str
    rate: float
    count: int = 0


class MessagePublisher:
    """Creates publishers on demand; may only be used in the executor's thread."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publishers: dict[tuple[str, str], Any] = {}
        self._running: dict[str, _RepeatedMessage] = {}
        self._repeated: Mapping[str, Repeated] = {}

    def publish(self, topic: str, type_name: str, values: Values, rate: float, graph: GraphInfo) -> None:
        """Publish once (rate 0), or at a rate (Hz), which replaces an earlier repeated message on this topic.

        Raises `ValueError` if the message cannot be filled in.
        """
        message, now = filled(Payload.MESSAGE, type_name, values)
        publisher = self._publisher(topic, type_name, type(message), graph)

        def send() -> None:
            stamp(message, now, lambda: self._node.get_clock().now().to_msg())
            publisher.publish(message)

        if rate:
            self.stop(topic)
            running = _RepeatedMessage(None, type_name, rate)

            def again() -> None:
                send()
                running.count += 1

            running.timer = self._node.create_timer(1.0 / rate, again)
            self._running[topic] = running
            return
        heard = any(each.name == topic for node in graph.nodes for each in node.subscriptions)
        self._when_matched(publisher, send, MAX_MATCH_POLLS if heard else 0)

    def _publisher(self, topic: str, type_name: str, kind: Any, graph: GraphInfo) -> Any:
        key = topic, type_name
        if key not in self._publishers:
            wanted = [each.qos for node in graph.nodes for each in node.subscriptions if each.name == topic]
            profile = QoSProfile(depth=10)
            if any("transient local" in each for each in wanted):
                profile = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self._publishers[key] = self._node.create_publisher(kind, topic, profile)
        return self._publishers[key]

    def _when_matched(self, publisher: Any, send: Any, polls: int) -> None:
        """Send once the publisher has a subscription, or after a while in any case."""
        if not polls or publisher.get_subscription_count():
            send()
            return
        left = [polls]

        def poll() -> None:
            left[0] -= 1
            if publisher.get_subscription_count() or left[0] <= 0:
                self._node.destroy_timer(timer)
                send()

        timer = self._node.create_timer(MATCH_POLL_S, poll)

    def stop(self, topic: str = "") -> None:
        """Stop publishing repeatedly, on one topic or on all."""
        for name in [topic] if topic else list(self._running):
            running = self._running.pop(name, None)
            if running is not None:
                self._node.destroy_timer(running.timer)

    def repeated(self) -> Mapping[str, Repeated]:
        """The messages being published at a rate; from any thread."""
        found = {topic: Repeated(each.type, each.rate, each.count) for topic, each in list(self._running.items())}
        if found != self._repeated:
            self._repeated = found
        return self._repeated
