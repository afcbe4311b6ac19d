"""The ROS graph as the panes see it: nodes and their publishers, subscriptions, servers and clients."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A publisher, subscription, service server or client of a node."""

    name: str
    types: tuple[str, ...]
    qos: str = ""
    """A short text such as `reliable volatile 10`; empty when unknown."""


@dataclass(frozen=True, slots=True)
class NodeInfo:
    """A node of the ROS graph by its fully qualified name."""

    name: str
    publishers: tuple[Endpoint, ...] = ()
    subscriptions: tuple[Endpoint, ...] = ()
    services: tuple[Endpoint, ...] = ()
    clients: tuple[Endpoint, ...] = ()
    action_servers: tuple[Endpoint, ...] = ()
    action_clients: tuple[Endpoint, ...] = ()
    copies: int = 1
    """How many nodes of the graph have this name; `NodeInfo` contains the endpoints of all of them."""

    @property
    def hidden(self) -> bool:
        """Whether any part of the name starts with an underscore."""
        return "/_" in self.name


class IncompatiblePair(NamedTuple):
    """The nodes of a publisher and a subscription between which the middleware passes no messages, and the reason."""

    publisher: str
    subscription: str
    reason: str


@dataclass(frozen=True, slots=True)
class GraphInfo:
    """The ROS graph.

    `unheard`: why messages do not pass between endpoints that define a type differently; `incompatible`: the pairs
    whose QoS does not match, by topic; `frozen`: stopped nodes with their pids; `debugged`: nodes stopped in a
    debugger, with the line if known; `silent`: nodes that do not answer; `lifecycle`: the states of the lifecycle nodes
    that have reported one.
    """

    nodes: tuple[NodeInfo, ...] = ()
    topics: tuple[Endpoint, ...] = ()
    services: tuple[Endpoint, ...] = ()
    unheard: tuple[str, ...] = ()
    frozen: tuple[tuple[str, int], ...] = ()
    debugged: tuple[tuple[str, str], ...] = ()
    silent: tuple[str, ...] = ()
    incompatible: Mapping[str, tuple[IncompatiblePair, ...]] = field(
        default_factory=dict[str, tuple[IncompatiblePair, ...]]
    )
    lifecycle: Mapping[str, str] = field(default_factory=dict[str, str])
