"""The inter-process bus: local messages are passed as objects, all others in the wire format of rmw_zenoh."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from bot_console.runtime.rmw.bus import PublisherEndpoint, Thing
from bot_console.runtime.rmw.endpoints import (
    ClientEndpoint,
    Endpoint,
    GraphChanged,
    MessageObserver,
    NodeId,
    OnEvent,
    Payload,
    ServiceEndpoint,
    SubscriptionEndpoint,
)
from bot_console.runtime.rmw.graph_tables import GraphTables
from bot_console.runtime.rmw.local import LocalBus
from bot_console.runtime.rmw.zenoh.declarations import Declaration
from bot_console.runtime.rmw.zenoh.graph_cache import Listener, Watches
from bot_console.runtime.rmw.zenoh.remote_publisher import RemotePublisher
from bot_console.runtime.rmw.zenoh.remote_subscription import RemoteSubscription
from bot_console.runtime.rmw.zenoh.sender import Sender
from bot_console.runtime.rmw.zenoh.services import RemoteClient, RequestReceiver, RequestSender
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.whole_graph import WholeGraph
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of
from bot_console.runtime.rmw.zenoh.wire.keys import data_key
from bot_console.runtime.rmw.zenoh.wire.qos_text import encode_qos
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, Token, TokenNode, entity_token, node_token
from bot_console.runtime.rosidl import type_hash

SERVICE_QOS = "::,10:,:,:,,"
"""Reliable, volatile, keep last 10: rmw's default profile for services."""

FLUSH_TIMEOUT_S = 0.3
"""How long leaving or closing waits for the queue of messages that must not be dropped, in s."""

RemoteEnd = RemotePublisher | RemoteSubscription | RequestReceiver | RequestSender


class Bridge(NamedTuple):
    """The session's objects for one endpoint of this process."""

    remote: RemoteEnd
    token: Declaration
    watched: tuple[Kind, str, Listener] | None = None


class BridgedNode(NamedTuple):
    """A node of this process as other processes see it."""

    node: TokenNode
    token: Declaration
    bridges: dict[Any, Bridge]


class ZenohBus:
    """The middleware of one ROS domain, shared with the other processes in the session's mesh."""

    def __init__(self, session: Session, local: LocalBus) -> None:
        self._session = session
        self._local = local
        self._numbers = itertools.count()
        self._lock = threading.Lock()
        self._nodes: dict[NodeId, BridgedNode] = {}
        self._disowned: dict[Any, Bridge] = {}
        self._own: set[bytes] = set()
        self._watches = Watches(session)
        self._sender = Sender()
        self._whole_graph: WholeGraph | None = None
        self._whole_lock = threading.Lock()
        session.on_rejoin = self._send_again

    def leave(self) -> None:
        """Remove the session's socket, for a process that exits at once."""
        self._sender.end(FLUSH_TIMEOUT_S)
        self._session.leave()

    def add_node(self, name: str, namespace: str, enclave: str) -> NodeId:
        """Add a node to the graph."""
        node = self._local.add_node(name, namespace, enclave)
        shown = TokenNode(self._session.zid, next(self._numbers), enclave, namespace, name)
        token = self._session.declare_token(node_token(self._session.domain, shown))
        with self._lock:
            self._nodes[node] = BridgedNode(shown, token, {})
        return node

    def remove_node(self, node: NodeId) -> None:
        """Remove a node and all its endpoints from the graph."""
        with self._lock:
            bridged = self._nodes.pop(node, None)
        self._local.remove_node(node)
        if bridged is None:
            return
        for bridge in bridged.bridges.values():
            self._take_down(bridge)
        bridged.token.undeclare()

    def create_publisher(self, endpoint: Endpoint, on_event: OnEvent) -> PublisherEndpoint:
        """Create a publisher; it serializes only if another process subscribes, or if it keeps samples for late
        subscribers.
        """
        key, shown = self._names(endpoint.node, "MP", endpoint)
        publisher = self._local.create_publisher(endpoint, on_event)
        if shown:
            self._own.add(endpoint.gid)
            remote_publisher = RemotePublisher(self._session, self._sender, publisher, key)
            watched: tuple[Kind, str, Listener] = ("MS", endpoint.topic, self._with_report(remote_publisher.on_token))
            self._keep(endpoint.node, publisher, Bridge(remote_publisher, self._session.declare_token(shown), watched))
        return publisher

    def create_subscription(self, subscription: SubscriptionEndpoint) -> None:
        """Add a subscription, which also receives from other processes."""
        endpoint = subscription.endpoint
        key, shown = self._names(endpoint.node, "MS", endpoint)
        self._local.create_subscription(subscription)
        if shown:
            remote_subscription = RemoteSubscription(self._session, subscription, key, self._own, self._local.tap)
            watched: tuple[Kind, str, Listener] = (
                "MP",
                endpoint.topic,
                self._with_report(remote_subscription.on_token),
            )
            self._watches.listen(*watched)  # the publishers must be known before the first message arrives
            remote_subscription.open()
            self._keep(
                endpoint.node, subscription, Bridge(remote_subscription, self._session.declare_token(shown), watched)
            )

    def create_service(self, service: ServiceEndpoint) -> None:
        """Add a service server, which also receives requests from other processes."""
        key, shown = self._names(service.node, "SS", service)
        self._local.create_service(service)
        if shown:
            served = RequestReceiver(self._session, service, key)
            self._keep(service.node, service, Bridge(served, self._session.declare_token(shown)))

    def create_client(self, client: ClientEndpoint) -> None:
        """Add a service client to the graph."""
        key, shown = self._names(client.node, "SC", client)
        self._local.create_client(client)
        if shown:
            asking = RequestSender(self._session, client, key)
            watched: tuple[Kind, str, Listener] = ("SS", client.name, self._with_report(asking.on_token))
            self._keep(client.node, client, Bridge(asking, self._session.declare_token(shown), watched))

    def _names(self, node: NodeId, kind: Kind, thing: Endpoint | ServiceEndpoint | ClientEndpoint) -> tuple[str, str]:
        """Return the key and the token of a new entity and assign its id; both are empty if its node has left the
        graph.
        """
        with self._lock:
            bridged = self._nodes.get(node)
        if bridged is None:
            return "", ""
        if isinstance(thing, Endpoint):
            name, cls, qos = thing.topic, thing.message_class, encode_qos(thing.qos)
        else:
            name, cls, qos = thing.name, thing.service_class, SERVICE_QOS
        domain, hashed = self._session.domain, type_hash.text(cls)
        token = entity_token(domain, bridged.node, next(self._numbers), kind, name, thing.type_name, hashed, qos)
        if not isinstance(thing, ServiceEndpoint):
            thing.gid = gid_of(token)
        return data_key(domain, name, thing.type_name, hashed), token

    def _keep(self, node: NodeId, thing: Any, bridge: Bridge) -> None:
        with self._lock:
            bridged = self._nodes.get(node)
            if bridged is not None:
                bridged.bridges[thing] = bridge
        if bridged is None:  # the node has left meanwhile
            self._take_down(bridge)
        elif bridge.watched and not isinstance(bridge.remote, RemoteSubscription):
            self._watches.listen(*bridge.watched)

    def _with_report(self, saw: Listener) -> Listener:
        """Wrap a listener so that each change also notifies the graph's watchers."""

        def report(token: Token, came: bool) -> None:
            saw(token, came)
            self._local.changed((token.node.name, token.node.namespace))

        return report

    def _take_down(self, bridge: Bridge) -> None:
        if bridge.watched:
            self._watches.forget(*bridge.watched)
        bridge.token.undeclare()
        bridge.remote.close()
        if isinstance(bridge.remote, RemotePublisher):
            self._own.discard(bridge.remote.gid)

    def disown(self, thing: ServiceEndpoint | ClientEndpoint) -> None:
        """Keep a service server or client in the graph when its node leaves."""
        self._local.disown(thing)
        with self._lock:
            bridged = self._nodes.get(thing.node)
            bridge = bridged.bridges.pop(thing, None) if bridged else None
            if bridge:
                self._disowned[thing] = bridge

    def remove(self, thing: Thing) -> None:
        """Remove an endpoint; does nothing if it was already removed."""
        self._local.remove(thing)
        node = thing.node if isinstance(thing, (ServiceEndpoint, ClientEndpoint)) else thing.endpoint.node
        with self._lock:
            bridged = self._nodes.get(node)
            bridge = self._disowned.pop(thing, None) or (bridged.bridges.pop(thing, None) if bridged else None)
        if bridge:
            self._take_down(bridge)

    def _bridge(self, thing: ServiceEndpoint | ClientEndpoint) -> RemoteEnd | None:
        with self._lock:
            bridged = self._nodes.get(thing.node)
            bridge = bridged.bridges.get(thing) if bridged else None
        return bridge.remote if bridge else None

    def request(self, client: ClientEndpoint, number: int, request: Payload) -> None:
        """Send a request to local and remote servers; it is lost if there are none."""
        self._local.request(client, number, request)
        asking = self._bridge(client)
        if isinstance(asking, RequestSender) and (asking.has_server or not self._local.has_server(client)):
            asking.request(number, request)

    def respond(self, client: ClientEndpoint, number: int, response: Payload) -> None:
        """Send a response to the client that made the request."""
        if isinstance(client, RemoteClient):
            client.served.respond(client, number, response)
        else:
            self._local.respond(client, number, response)

    def has_server(self, client: ClientEndpoint) -> bool:
        """Whether a server of the client's service exists, in this process or another."""
        asking = self._bridge(client)
        return self._local.has_server(client) or (isinstance(asking, RequestSender) and asking.has_server)

    def watch_servers(self, client: ClientEndpoint) -> Callable[[], bool]:
        """Return a function that tells whether all servers that a client has now are known to have ended."""
        asking = self._bridge(client)
        if isinstance(asking, RequestSender) and asking.has_server:
            return asking.watch_servers()
        return self._local.watch_servers(client)

    def _graph(self) -> WholeGraph:
        """Return the graph of the other processes; the first call starts watching it."""
        with self._whole_lock:
            if self._whole_graph is None:
                self._whole_graph = WholeGraph(self._session, self._local.changed, self._watches.known)
            return self._whole_graph

    def tables(self) -> Sequence[GraphTables]:
        """Return the graph tables of this process and of the other processes."""
        return (*self._local.tables(), self._graph().tables)

    def stopped(self) -> Mapping[int, Sequence[str]]:
        """Return the frozen processes of the mesh by pid, with their nodes; Zenoh takes a long time to notice them."""
        return self._nodes_of(self._session.stopped())

    def processes(self) -> Mapping[int, Sequence[str]]:
        """Return the processes of the mesh on this machine, by pid, with their nodes."""
        return self._nodes_of(self._session.processes())

    def _nodes_of(self, pids: Mapping[str, int]) -> Mapping[int, Sequence[str]]:
        if not pids:
            return {}
        nodes = self._graph().nodes_of(pids)
        return {pid: nodes.get(session, ()) for session, pid in pids.items()}

    def debugged(self) -> Mapping[str, str]:
        """Return the nodes of the mesh's processes that are stopped in a debugger, each with the current line."""
        lines = self._session.debugged()
        if not lines:
            return {}
        nodes = self._graph().nodes_of(lines)
        return {node: lines[session] for session, names in nodes.items() for node in names}

    def on_graph_change(self, callback: GraphChanged) -> Callable[[], None]:
        """Call `callback` on each graph change that this process sees; returns a function that removes the callback."""
        return self._local.on_graph_change(callback)

    def monitor(self, observer: MessageObserver | None) -> None:
        """Pass what this process publishes and its subscriptions receive to `observer`; None removes the observer."""
        self._local.monitor(observer)

    def published(self) -> int:
        """Total number of messages published by the current publishers of this process."""
        return self._local.published()

    def close(self) -> None:
        """Leave the mesh; communication within this process goes on."""
        self._sender.end(FLUSH_TIMEOUT_S)
        self._session.close()

    def _send_again(self) -> None:
        """After a reopening, publish again what latching publishers keep, and send the requests that were held back."""
        with self._lock:
            remotes = [bridge.remote for each in self._nodes.values() for bridge in each.bridges.values()]
        for remote in remotes:
            if isinstance(remote, RequestSender) or (isinstance(remote, RemotePublisher) and remote.latching):
                remote.send_again()
