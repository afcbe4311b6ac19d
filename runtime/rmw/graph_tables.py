"""The graph by node, topic and service, kept as it changes: a question costs what its answer holds.

Made anew at each change it would cost the square of what comes: hundreds of nodes that start ask and change by turns.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Sequence
from typing import Generic, TypeVar

from bot_console.runtime.rmw.endpoints import ClientEndpoint, Endpoint, NodeId, Owner, ServiceEndpoint

NamesAndTypes = list[tuple[str, list[str]]]

T = TypeVar("T", Endpoint, ServiceEndpoint, ClientEndpoint)
K = TypeVar("K")
E = TypeVar("E")
V = TypeVar("V")


class Entities(Generic[T]):
    """All publishers, subscriptions, servers or clients; from any thread."""

    def __init__(self, what: str) -> None:
        """`what` names the field that says of which topic or service one is."""
        self._what = what
        self._lock = threading.Lock()
        # Of each name, and of each node, in the order in which they came.
        self._named: dict[str, dict[T, None]] = {}
        self._owned: dict[Owner, dict[T, None]] = {}
        self._kinds: dict[str, dict[str, int]] = {}
        """How many of each type a name has."""

    def add(self, entity: T) -> None:
        """One has come; a second time does nothing."""
        name, kind = getattr(entity, self._what), entity.type_name
        with self._lock:
            row = self._named.setdefault(name, {})
            if entity in row:
                return
            row[entity] = None
            self._owned.setdefault(entity.node.owner, {})[entity] = None
            kinds = self._kinds.setdefault(name, {})
            kinds[kind] = kinds.get(kind, 0) + 1

    def remove(self, entity: T) -> None:
        """One has gone; a second time does nothing."""
        name, kind = getattr(entity, self._what), entity.type_name
        with self._lock:
            if entity not in self._named.get(name, ()):
                return
            _drop(self._named, name, entity)
            _drop(self._owned, entity.node.owner, entity)
            kinds = self._kinds[name]
            kinds[kind] -= 1
            if not kinds[kind]:
                _drop(self._kinds, name, kind)

    def on(self, name: str) -> Sequence[T]:
        """Those of a topic or service."""
        with self._lock:
            return list(self._named.get(name, ()))

    def of(self, owner: Owner) -> Iterable[tuple[str, str]]:
        """Names and types of what a node has."""
        with self._lock:
            return [(getattr(each, self._what), each.type_name) for each in self._owned.get(owner, ())]

    def pairs(self) -> Iterable[tuple[str, str]]:
        """All names with each of their types once."""
        with self._lock:
            return [(name, kind) for name, kinds in self._kinds.items() for kind in kinds]

    def all(self) -> Sequence[T]:
        """All, those of one name together."""
        with self._lock:
            return [each for row in self._named.values() for each in row]


class GraphTables:
    """What a bus knows of the nodes of one or of all processes."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._nodes: dict[NodeId, None] = {}
        self._owners: dict[Owner, int] = {}
        self.publishers: Entities[Endpoint] = Entities("topic")
        self.subscriptions: Entities[Endpoint] = Entities("topic")
        self.servers: Entities[ServiceEndpoint] = Entities("name")
        self.clients: Entities[ClientEndpoint] = Entities("name")

    def add_node(self, node: NodeId) -> None:
        """A node has come."""
        with self._lock:
            if node not in self._nodes:
                self._nodes[node] = None
                self._owners[node.owner] = self._owners.get(node.owner, 0) + 1

    def remove_node(self, node: NodeId) -> None:
        """A node has gone; a second time does nothing."""
        with self._lock:
            if node in self._nodes:
                del self._nodes[node]
                self._owners[node.owner] -= 1
                if not self._owners[node.owner]:
                    del self._owners[node.owner]

    def nodes(self) -> Sequence[NodeId]:
        """All nodes, in the order in which they came."""
        with self._lock:
            return list(self._nodes)

    def has(self, owner: Owner) -> bool:
        """Whether there is a node of that name."""
        return owner in self._owners


def collect(pairs: Iterable[tuple[str, str]]) -> NamesAndTypes:
    """Pairs of a name and a type as sorted names with their sorted types."""
    found: dict[str, list[str]] = {}
    for name, kind in pairs:
        kinds = found.setdefault(name, [])
        if kind not in kinds:
            kinds.append(kind)
    for kinds in found.values():
        if len(kinds) > 1:
            kinds.sort()
    return sorted(found.items())


def _drop(table: dict[K, dict[E, V]], key: K, entry: E) -> None:
    """Take an entry out of its row, and an empty row out of the table."""
    row = table[key]
    del row[entry]
    if not row:
        del table[key]
