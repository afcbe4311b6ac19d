"""What rclpy needs of a middleware: endpoints that take and give messages, and the graph."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

Notify = Callable[[], None]
"""Called, from any thread, when an endpoint has something new."""


@dataclass(frozen=True)
class NodeId:
    """A node of the graph; two nodes may have the same name, so identity counts."""

    name: str
    namespace: str
    enclave: str = "/"
    number: int = 0


@dataclass(eq=False)
class Endpoint:
    """A publisher or subscription as the graph knows it. `topic` is fully qualified, `gid` has 16 bytes."""

    node: NodeId
    topic: str
    type_name: str
    qos: Any
    gid: bytes
    message_class: Any = None


class PublisherEndpoint(Protocol):
    """Sends messages."""

    endpoint: Endpoint

    def publish(self, message: Any) -> None:
        """Give each matched subscription a copy of its own; raises `FieldTypeError` for what cannot be sent."""
        ...

    def assert_liveliness(self) -> None:
        """Give a sign of life."""
        ...

    def publish_own(self, message: Any) -> bool:
        """Publish a message that is well formed and that nobody else holds; it need not be copied.

        False when the publisher is closed: then nobody gets it.
        """
        ...

    def publish_raw(self, data: bytes) -> None:
        """The same for a serialized message."""
        ...

    def matched_count(self) -> int:
        """How many subscriptions receive."""
        ...


@dataclass(eq=False)
class SubscriptionEndpoint:
    """Receives messages: `queue` holds what has come, as (message, source ns, sequence number, expiry ns)."""

    endpoint: Endpoint
    raw: bool
    queue: deque[Any]
    notify: Notify
    on_event: Callable[[str, Any], None] = lambda kind, what: None
    matched: int = 0


@dataclass(eq=False)
class ServiceEndpoint:
    """Answers requests: `queue` holds (client, sequence number, request)."""

    node: NodeId
    name: str
    type_name: str
    notify: Notify
    queue: deque[Any] = field(default_factory=deque)


@dataclass(eq=False)
class ClientEndpoint:
    """Asks requests: `queue` holds (sequence number, response)."""

    node: NodeId
    name: str
    type_name: str
    notify: Notify
    queue: deque[Any] = field(default_factory=deque)


class Bus(Protocol):
    """A middleware. All methods may be called from any thread."""

    def add_node(self, name: str, namespace: str, enclave: str) -> NodeId:
        """Let a node appear in the graph."""
        ...

    def remove_node(self, node: NodeId) -> None:
        """Let a node and all its endpoints leave the graph."""
        ...

    def create_publisher(self, endpoint: Endpoint, on_event: Callable[[str, Any], None]) -> Any:
        """Make a publisher of a topic."""
        ...

    def create_subscription(self, subscription: SubscriptionEndpoint) -> None:
        """Let a subscription receive."""
        ...

    def create_service(self, service: ServiceEndpoint) -> None:
        """Let a service server receive requests."""
        ...

    def create_client(self, client: ClientEndpoint) -> None:
        """Let a client of a service appear in the graph."""
        ...

    def disown(self, thing: Any) -> None:
        """Let a service server or client stay when its node leaves."""
        ...

    def remove(self, thing: Any) -> None:
        """Take a publisher, subscription, server or client away."""
        ...

    def request(self, client: ClientEndpoint, number: int, request: Any) -> None:
        """Send a request to the servers; lost when there is none."""
        ...

    def respond(self, client: ClientEndpoint, number: int, response: Any) -> None:
        """Send a response to the client that asked."""
        ...

    def has_server(self, client: ClientEndpoint) -> bool:
        """Whether a server of the client's service is there."""
        ...

    def nodes(self) -> Sequence[NodeId]:
        """All nodes."""
        ...

    def publishers(self) -> Sequence[Endpoint]:
        """All publishers."""
        ...

    def subscriptions(self) -> Sequence[Endpoint]:
        """All subscriptions."""
        ...

    def servers(self) -> Sequence[ServiceEndpoint]:
        """All service servers."""
        ...

    def clients(self) -> Sequence[ClientEndpoint]:
        """All service clients."""
        ...

    def on_graph_change(self, callback: Notify) -> Callable[[], None]:
        """Call back at each change of the graph; returns what ends that."""
        ...
