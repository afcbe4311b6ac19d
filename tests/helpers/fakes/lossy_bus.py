"""A bus on which every message waits until a test delivers, loses or repeats it; and nodes that use this bus."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile


class SilentLogger:
    """Keeps what is logged."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def info(self, text: str, **options: Any) -> None:
        """Keep a line."""
        self.lines.append(text)

    warning = error = info


@dataclass
class Publisher:
    """Sends to current subscriptions; a latched publisher keeps its last message for later ones."""

    node: BusNode
    topic: str
    latched: bool
    last: Any = None

    def publish(self, message: Any) -> None:
        """Send a message."""
        self.last = message if self.latched else None
        self.node.bus.send(self.topic, message)


@dataclass
class Subscription:
    """Receives messages."""

    node: BusNode
    topic: str
    callback: Callable[[Any], None]


@dataclass
class LossyBus:
    """All nodes, everything ever sent, and the messages in transit."""

    nodes: list[BusNode] = field(default_factory=lambda: [])
    history: list[tuple[str, Any]] = field(default_factory=lambda: [])
    pending: list[tuple[Subscription, Any]] = field(default_factory=lambda: [])

    def send(self, topic: str, message: Any, *, again: bool = False) -> None:
        """Put a message in transit; `again` marks a replay of an earlier one."""
        if not again:
            self.history.append((topic, message))
        self.pending += [(each, message) for node in self.nodes for each in node.subscriptions if each.topic == topic]

    def deliver(self, index: int) -> None:
        """Deliver one of the messages in transit; the test chooses the order."""
        subscription, message = self.pending.pop(index % len(self.pending))
        if subscription.node in self.nodes:
            subscription.callback(message)

    def lose(self, index: int) -> None:
        """Lose one of the messages in transit."""
        self.pending.pop(index % len(self.pending))

    def settle(self) -> None:
        """Deliver all messages in order, including those sent in response."""
        while self.pending:
            self.deliver(0)

    def topics(self) -> set[str]:
        """The topics that have a publisher."""
        return {each.topic for node in self.nodes for each in node.publishers}


class BusNode:
    """The part of a node that the emergency stop uses; timers are called by the test."""

    def __init__(self, bus: LossyBus, name: str) -> None:
        self.bus, self.name = bus, name
        self.publishers: list[Publisher] = []
        self.subscriptions: list[Subscription] = []
        self.logger = SilentLogger()
        bus.nodes.append(self)

    def create_publisher(self, kind: type, topic: str, profile: QoSProfile | int) -> Publisher:
        """Publish on a topic."""
        latched = isinstance(profile, QoSProfile) and profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
        made = Publisher(self, _full(topic), latched)
        self.publishers.append(made)
        return made

    def create_subscription(
        self, kind: type, topic: str, callback: Callable[[Any], None], profile: QoSProfile | int, **options: Any
    ) -> Subscription:
        """Subscribe; messages kept by latched publishers are put in transit at once."""
        made = Subscription(self, _full(topic), callback)
        self.subscriptions.append(made)
        for each in [each for node in self.bus.nodes for each in node.publishers]:
            if each.topic == made.topic and each.last is not None:
                self.bus.pending.append((made, each.last))
        return made

    def destroy_subscription(self, subscription: Subscription) -> None:
        """Stop receiving."""
        self.subscriptions.remove(subscription)

    def create_service(self, *words: Any) -> None:
        """Do nothing: nobody calls the service."""

    def create_timer(self, *words: Any, **options: Any) -> None:
        """Do nothing: the test calls the callback itself."""

    def get_name(self) -> str:
        """The node's name."""
        return self.name

    def get_namespace(self) -> str:
        """The root namespace."""
        return "/"

    def get_logger(self) -> SilentLogger:
        """The logger."""
        return self.logger

    def kill(self) -> None:
        """End without notice."""
        self.bus.nodes.remove(self)


def _full(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"
