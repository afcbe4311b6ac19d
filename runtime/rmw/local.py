"""The bus within one process: matches endpoints, and passes messages as objects."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from bot_console.runtime.rmw.bus import Thing
from bot_console.runtime.rmw.endpoints import (
    ClientEndpoint,
    Endpoint,
    GraphChanged,
    MessageObserver,
    NodeId,
    OnEvent,
    Owner,
    Payload,
    ServiceEndpoint,
    SubscriptionEndpoint,
    Tap,
)
from bot_console.runtime.rmw.graph_tables import GraphTables
from bot_console.runtime.rmw.local_publisher import LocalPublisher
from bot_console.runtime.rmw.qos_matching import DDS, QosRules, wants_history

_T = TypeVar("_T")


class LocalBus:
    """The middleware of one ROS domain of this process."""

    def __init__(self, rules: QosRules = DDS) -> None:
        self.rules = rules
        # Reentrant, because callbacks about matches may create or remove endpoints.
        self._lock = threading.RLock()
        self._numbers = itertools.count(1)
        self._nodes: dict[NodeId, list[Thing]] = {}
        self._publishers: dict[str, list[LocalPublisher]] = {}
        self._subscriptions: dict[str, list[SubscriptionEndpoint]] = {}
        self._services: dict[str, list[ServiceEndpoint]] = {}
        self._clients: dict[str, list[ClientEndpoint]] = {}
        self._watchers: list[GraphChanged] = []
        self.tap = Tap()
        """Also used by those who receive messages for this process from elsewhere."""
        self._tables = GraphTables(self._lock)

    def published(self) -> int:
        """Total number of messages published by the current publishers."""
        with self._lock:
            return sum(each.published for publishers in self._publishers.values() for each in publishers)

    def processes(self) -> Mapping[int, Sequence[str]]:
        """Return nothing: this bus knows no other processes."""
        return {}

    def monitor(self, observer: MessageObserver | None) -> None:
        """Pass each published message to `observer`, without a subscription; None removes the observer."""
        self.tap.observer = observer

    def add_node(self, name: str, namespace: str, enclave: str) -> NodeId:
        """Add a node to the graph."""
        node = NodeId(name, namespace, enclave, next(self._numbers))
        with self._lock:
            self._nodes[node] = []
            self._tables.add_node(node)
        self.changed(node.owner)
        return node

    def remove_node(self, node: NodeId) -> None:
        """Remove a node and its remaining endpoints from the graph."""
        with self._lock:
            for thing in list(self._nodes.get(node, ())):
                self._take_away(thing)
            self._nodes.pop(node, None)
            self._tables.remove_node(node)
        self.changed(node.owner)

    def create_publisher(self, endpoint: Endpoint, on_event: OnEvent) -> LocalPublisher:
        """Create a publisher and match it with the subscriptions."""
        publisher = LocalPublisher(endpoint, on_event, self._lock, self.tap, self.rules.lifespan(endpoint.qos))
        with self._lock:
            if not self._own(endpoint.node, publisher):
                return publisher
            self._publishers.setdefault(endpoint.topic, []).append(publisher)
            matched: list[SubscriptionEndpoint] = []
            for each in self._subscriptions.get(endpoint.topic, ()):
                if self._match(publisher, each):
                    matched.append(each)
            # Replaced, never mutated: `publish` iterates over it without a lock.
            publisher.targets = tuple(matched)
            self._tables.publishers.add(endpoint)
        self.changed(endpoint.node.owner)
        return publisher

    def create_subscription(self, subscription: SubscriptionEndpoint) -> None:
        """Add a subscription, which also receives the messages kept for late subscriptions."""
        endpoint = subscription.endpoint
        with self._lock:
            if not self._own(endpoint.node, subscription):
                return
            self._subscriptions.setdefault(endpoint.topic, []).append(subscription)
            self._tables.subscriptions.add(endpoint)
            publishers = self._publishers.get(endpoint.topic, ())
            late = wants_history(endpoint.qos, [each.endpoint.qos for each in publishers])
            for publisher in publishers:
                if self._match(publisher, subscription):
                    publisher.targets = (*publisher.targets, subscription)
                    if late and publisher.history:
                        publisher.late(subscription)
        self.changed(endpoint.node.owner)

    def _match(self, publisher: LocalPublisher, subscription: SubscriptionEndpoint) -> bool:
        """Whether a publisher and a subscription match; notifies both."""
        if publisher.endpoint.type_name != subscription.endpoint.type_name:
            return False
        if hasattr(publisher.endpoint.message_class, "_given_digest") and not subscription.raw:
            return False  # it has bytes only, of a type whose class this subscription has learned since
        policy = self.rules.incompatible_policy(publisher.endpoint.qos, subscription.endpoint.qos)
        if policy:
            publisher.on_event("incompatible", policy)
            subscription.on_event("incompatible", policy)
            return False
        subscription.matched += 1
        publisher.on_event("matched", 1)
        subscription.on_event("matched", 1)
        subscription.on_event("alive", publisher)
        return True

    def create_service(self, service: ServiceEndpoint) -> None:
        """Add a service server, which then receives requests."""
        with self._lock:
            if self._own(service.node, service):
                self._services.setdefault(service.name, []).append(service)
                self._tables.servers.add(service)
        self.changed(service.node.owner)

    def create_client(self, client: ClientEndpoint) -> None:
        """Add a service client to the graph."""
        with self._lock:
            if self._own(client.node, client):
                self._clients.setdefault(client.name, []).append(client)
                self._tables.clients.add(client)
        self.changed(client.node.owner)

    def _own(self, node: NodeId, thing: Thing) -> bool:
        """Record a node's endpoint; returns False if the node has left the graph, e.g. killed while still running."""
        things = self._nodes.get(node)
        if things is None:
            return False
        things.append(thing)
        return True

    def disown(self, thing: ServiceEndpoint | ClientEndpoint) -> None:
        """Keep a service server or client in the graph when its node leaves."""
        with self._lock:
            things = self._nodes.get(thing.node, [])
            if thing in things:
                things.remove(thing)

    def remove(self, thing: Thing) -> None:
        """Remove an endpoint; does nothing if it was already removed."""
        with self._lock:
            self._take_away(thing)
        self.changed(_owner(thing).owner)

    def _take_away(self, thing: Thing) -> None:
        if isinstance(thing, LocalPublisher):
            self._take_publisher(thing)
        elif isinstance(thing, SubscriptionEndpoint):
            self._take_subscription(thing)
        elif isinstance(thing, ServiceEndpoint):
            _drop(self._services, thing.name, thing)
            self._tables.servers.remove(thing)
        elif isinstance(thing, ClientEndpoint):
            _drop(self._clients, thing.name, thing)
            self._tables.clients.remove(thing)
        # Empty if the node left first.
        things = self._nodes.get(_owner(thing))
        if things and thing in things:
            things.remove(thing)

    def _take_publisher(self, publisher: LocalPublisher) -> None:
        publisher.open = False
        _drop(self._publishers, publisher.endpoint.topic, publisher)
        self._tables.publishers.remove(publisher.endpoint)
        for target in publisher.targets:
            target.matched -= 1
            target.on_event("matched", -1)
            target.on_event("gone", publisher)
        publisher.targets = ()

    def _take_subscription(self, subscription: SubscriptionEndpoint) -> None:
        topic = subscription.endpoint.topic
        _drop(self._subscriptions, topic, subscription)
        self._tables.subscriptions.remove(subscription.endpoint)
        for publisher in self._publishers.get(topic, ()):
            if subscription in publisher.targets:
                publisher.targets = tuple(each for each in publisher.targets if each is not subscription)
                publisher.on_event("matched", -1)

    def request(self, client: ClientEndpoint, number: int, request: Payload) -> None:
        """Put a copy of the request into the queue of each server of the service."""
        for server in tuple(self._services.get(client.name, ())):
            if server.type_name == client.type_name:
                server.queue.append((client, number, request._copy_()))
                server.notify()

    def respond(self, client: ClientEndpoint, number: int, response: Payload) -> None:
        """Put a copy of the response into the client's queue."""
        client.queue.append((number, response._copy_()))
        client.notify()

    def has_server(self, client: ClientEndpoint) -> bool:
        """Whether a server of the client's service exists."""
        return any(each.type_name == client.type_name for each in tuple(self._services.get(client.name, ())))

    def watch_servers(self, client: ClientEndpoint) -> Callable[[], bool]:
        """Return a function that tells whether all servers that a client has now have ended."""
        present = self.has_server(client)
        return lambda: present and not self.has_server(client)

    def tables(self) -> Sequence[GraphTables]:
        """Return the graph tables of this process."""
        return (self._tables,)

    def on_graph_change(self, callback: GraphChanged) -> Callable[[], None]:
        """Call `callback` on each change of the graph; returns a function that removes the callback."""
        with self._lock:
            self._watchers.append(callback)

        def end() -> None:
            with self._lock:
                if callback in self._watchers:
                    self._watchers.remove(callback)

        return end

    def stopped(self) -> Mapping[int, Sequence[str]]:
        """Return nothing: the only process here is this one, and it is running."""
        return {}

    def debugged(self) -> Mapping[str, str]:
        """Return nothing: this bus knows no other processes."""
        return {}

    def changed(self, owner: Owner) -> None:
        """Notify the graph's watchers of the node whose entries have changed."""
        # Called without the lock, as watchers query the bus about the change.
        for watcher in tuple(self._watchers):
            watcher(owner)


def _drop(table: dict[str, list[_T]], key: str, thing: _T) -> None:
    rows = table.get(key, [])
    if thing in rows:
        rows.remove(thing)
    if not rows:
        table.pop(key, None)


def _owner(thing: Thing) -> NodeId:
    return thing.node if isinstance(thing, (ServiceEndpoint, ClientEndpoint)) else thing.endpoint.node


_buses: dict[int, LocalBus] = {}
_buses_lock = threading.Lock()


def local_bus(domain: int) -> LocalBus:
    """Return the bus of a ROS domain in this process, created on first use."""
    with _buses_lock:
        return _buses.setdefault(domain, LocalBus())
