"""The interface of a middleware that rclpy needs: endpoints that send and receive messages, and the graph."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from bot_console.runtime.rmw.endpoints import (
    ClientEndpoint,
    Endpoint,
    GraphChanged,
    MessageObserver,
    NodeId,
    Notify,
    OnEvent,
    Payload,
    ServiceEndpoint,
    SubscriptionEndpoint,
)
from bot_console.runtime.rmw.graph_tables import GraphTables


class Publisher(Protocol):
    """A publisher of this process or another, as passed to a subscription's event handlers."""

    @property
    def lease(self) -> int | None:
        """How long (ns) it counts as alive without asserting its liveliness; None for as long as it exists."""
        ...


class PublisherEndpoint(Publisher, Protocol):
    """Sends messages."""

    on_publish: Notify | None
    """Called for each published message while somebody observes them; otherwise None."""

    @property
    def endpoint(self) -> Endpoint:
        """The publisher's entry in the graph."""
        ...

    def publish(self, message: Payload) -> None:
        """Send each matched subscription its own copy; raises `FieldTypeError` for a message that cannot be sent."""
        ...

    def publish_own(self, message: Payload) -> bool:
        """Publish a well-formed message that nobody else holds, so it need not be copied.

        Returns False if the publisher is closed: then nobody receives the message.
        """
        ...

    def skip(self) -> None:
        """Count a message that was not created because nobody would receive it."""
        ...

    def publish_raw(self, data: bytes) -> None:
        """Publish a serialized message."""
        ...

    def assert_liveliness(self) -> None:
        """Assert the publisher's liveliness."""
        ...

    def matched_count(self) -> int:
        """Number of matched subscriptions."""
        ...

    def is_heard(self) -> bool:
        """Whether anybody receives what is published: a subscription, here or elsewhere, or an observer."""
        ...


Thing = PublisherEndpoint | SubscriptionEndpoint | ServiceEndpoint | ClientEndpoint
"""An endpoint of a node."""


class Bus(Protocol):
    """A middleware in one ROS domain. All methods are thread-safe, and none waits for another process."""

    def add_node(self, name: str, namespace: str, enclave: str) -> NodeId:
        """Add a node to the graph."""
        ...

    def remove_node(self, node: NodeId) -> None:
        """Remove a node and all its endpoints from the graph."""
        ...

    def create_publisher(self, endpoint: Endpoint, on_event: OnEvent) -> PublisherEndpoint:
        """Create a publisher. If its node has left the graph, it publishes nowhere."""
        ...

    def create_subscription(self, subscription: SubscriptionEndpoint) -> None:
        """Add a subscription, which also receives what latching publishers have kept."""
        ...

    def create_service(self, service: ServiceEndpoint) -> None:
        """Add a service server, which then receives requests."""
        ...

    def create_client(self, client: ClientEndpoint) -> None:
        """Add a service client to the graph."""
        ...

    def disown(self, thing: ServiceEndpoint | ClientEndpoint) -> None:
        """Keep a service server or client in the graph when its node leaves."""
        ...

    def remove(self, thing: Thing) -> None:
        """Remove a publisher, subscription, server or client; does nothing if it was already removed."""
        ...

    def request(self, client: ClientEndpoint, number: int, request: Payload) -> None:
        """Send a request to the servers; it is lost if there are none."""
        ...

    def respond(self, client: ClientEndpoint, number: int, response: Payload) -> None:
        """Send a response to the client that made the request."""
        ...

    def has_server(self, client: ClientEndpoint) -> bool:
        """Whether a server of the client's service exists."""
        ...

    def watch_servers(self, client: ClientEndpoint) -> Callable[[], bool]:
        """Return a function that tells whether all servers that a client has now are known to have ended.

        A lost link does not prove that; if there is no server now, the function returns False.
        """
        ...

    def tables(self) -> Sequence[GraphTables]:
        """Return the graph tables of this process, and of the other processes if there are any."""
        ...

    def on_graph_change(self, callback: GraphChanged) -> Callable[[], None]:
        """Call `callback` on each change of the graph; returns a function that removes the callback."""
        ...

    def stopped(self) -> Mapping[int, Sequence[str]]:
        """Return the frozen processes by pid, each with its nodes' names as far as known."""
        ...

    def processes(self) -> Mapping[int, Sequence[str]]:
        """Return this machine's other processes in the domain by pid, each with its nodes' names as far as known."""
        ...

    def debugged(self) -> Mapping[str, str]:
        """Return the nodes whose processes are stopped in a debugger, each with the current line, as far as known.

        The line is `/path/file.py:12, in function`, or empty if it is unknown.
        """
        ...

    def monitor(self, observer: MessageObserver | None) -> None:
        """Pass each message that this process publishes or receives to `observer`; None removes the observer.

        The observer is not a subscription: publishers and the graph do not show it, and nothing is sent on its behalf.
        """
        ...

    def published(self) -> int:
        """Total number of messages published by the current publishers of this process."""
        ...
