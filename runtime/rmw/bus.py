"""What rclpy needs from a middleware: endpoints that take and deliver messages, and the graph."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from bot_console.runtime.rmw.endpoints import (
    ClientEndpoint,
    Endpoint,
    GraphChanged,
    Hear,
    Message,
    NodeId,
    Notify,
    OnEvent,
    ServiceEndpoint,
    SubscriptionEndpoint,
)
from bot_console.runtime.rmw.graph_tables import GraphTables


class Publisher(Protocol):
    """A publisher, of this process or another, as a subscription's events name it."""

    @property
    def lease(self) -> int | None:
        """How long (ns) it counts as alive without a sign of life; None for as long as it is there."""
        ...


class PublisherEndpoint(Publisher, Protocol):
    """Sends messages."""

    on_publish: Notify | None
    """Called with each message, where somebody watches that."""

    @property
    def endpoint(self) -> Endpoint:
        """How the graph knows it."""
        ...

    def publish(self, message: Message) -> None:
        """Give each matched subscription a copy of its own; raises `FieldTypeError` for what cannot be sent."""
        ...

    def publish_own(self, message: Message) -> bool:
        """Publish a message that is well formed and that nobody else holds; it need not be copied.

        False when the publisher is closed: then nobody gets it.
        """
        ...

    def skip(self) -> None:
        """Count a message that was not made, since it is not wanted."""
        ...

    def publish_raw(self, data: bytes) -> None:
        """The same for a serialized message."""
        ...

    def assert_liveliness(self) -> None:
        """Give a sign of life."""
        ...

    def matched_count(self) -> int:
        """How many subscriptions receive."""
        ...

    def is_heard(self) -> bool:
        """Whether anybody gets what is published: a subscription, here or elsewhere, or who overhears all."""
        ...


Thing = PublisherEndpoint | SubscriptionEndpoint | ServiceEndpoint | ClientEndpoint
"""What a node has on a bus."""


class Bus(Protocol):
    """A middleware in one ROS domain. All methods may be called from any thread, and none waits for another process."""

    def add_node(self, name: str, namespace: str, enclave: str) -> NodeId:
        """Let a node appear in the graph."""
        ...

    def remove_node(self, node: NodeId) -> None:
        """Let a node and all its endpoints leave the graph."""
        ...

    def create_publisher(self, endpoint: Endpoint, on_event: OnEvent) -> PublisherEndpoint:
        """Make a publisher of a topic. One whose node has left the graph publishes nowhere."""
        ...

    def create_subscription(self, subscription: SubscriptionEndpoint) -> None:
        """Let a subscription receive, what latching publishers kept for it included."""
        ...

    def create_service(self, service: ServiceEndpoint) -> None:
        """Let a service server receive requests."""
        ...

    def create_client(self, client: ClientEndpoint) -> None:
        """Let a client of a service appear in the graph."""
        ...

    def disown(self, thing: ServiceEndpoint | ClientEndpoint) -> None:
        """Let a service server or client stay when its node leaves."""
        ...

    def remove(self, thing: Thing) -> None:
        """Take a publisher, subscription, server or client away; a second time does nothing."""
        ...

    def request(self, client: ClientEndpoint, number: int, request: Message) -> None:
        """Send a request to the servers; lost when there is none."""
        ...

    def respond(self, client: ClientEndpoint, number: int, response: Message) -> None:
        """Send a response to the client that asked."""
        ...

    def has_server(self, client: ClientEndpoint) -> bool:
        """Whether a server of the client's service is there."""
        ...

    def tables(self) -> Sequence[GraphTables]:
        """The graph: of this process, and of the others where there are any."""
        ...

    def on_graph_change(self, callback: GraphChanged) -> Callable[[], None]:
        """Call back at each change of the graph; returns what ends that."""
        ...

    def stopped(self) -> Mapping[int, Sequence[str]]:
        """The processes that are frozen, by pid, with their nodes; where that is known."""
        ...

    def overhear(self, hear: Hear | None) -> None:
        """Hand over each message that this process publishes or receives; None ends that.

        Who overhears is no subscription: publishers and the graph do not know, and nothing is sent for it.
        """
        ...

    def published(self) -> int:
        """How many messages the present publishers of this process have published in all."""
        ...
