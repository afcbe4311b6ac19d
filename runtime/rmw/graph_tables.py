"""The graph indexed by node, topic and service, and updated as it changes: a query costs what its answer holds.

Rebuilding it at each change would be quadratic: hundreds of starting nodes alternate between queries and changes.
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


class Entities(Generic[T]):
    """All publishers, subscriptions, servers or clients; from any thread."""

    def __init__(self, what: str, lock: threading.RLock) -> None:
        """`what` names the field that says of which topic or service one is."""
        self._what = what
        self._lock = lock
        # Of each name, and of each node, in the order in which they came.
        self._named: dict[str, dict[T, None]] = {}
        self._owned: dict[Owner, dict[T, None]] = {}
        self._kinds: dict[tuple[str, str], dict[T, None]] = {}
        """Of each name with each of its types."""

    def add(self, entity: T) -> None:
        """One has come; a second time does nothing."""
        name, kind = getattr(entity, self._what), entity.type_name
        with self._lock:
            _put(self._named, name, entity)
            _put(self._owned, entity.node.owner, entity)
            _put(self._kinds, (name, kind), entity)

    def remove(self, entity: T) -> None:
        """One has gone; a second time does nothing."""
        name, kind = getattr(entity, self._what), entity.type_name
        with self._lock:
            _drop(self._named, name, entity)
            _drop(self._owned, entity.node.owner, entity)
            _drop(self._kinds, (name, kind), entity)

    def on(self, name: str) -> Sequence[T]:
        """Those of a topic or service."""
        with self._lock:
            return [*self._named.get(name, {}).copy()]

    def of(self, owner: Owner) -> Iterable[tuple[str, str]]:
        """Names and types of what a node has."""
        with self._lock:
            owned = self._owned.get(owner, {}).copy()
        return [(getattr(each, self._what), each.type_name) for each in owned]

    def pairs(self) -> Iterable[tuple[str, str]]:
        """All names with each of their types once."""
        with self._lock:
            return [*self._kinds.copy()]

    def all(self) -> Sequence[T]:
        """All, those of one name together."""
        with self._lock:
            named = self._named.copy()
        return [each for row in named.values() for each in row.copy()]


class GraphTables:
    """What a bus knows of the nodes of one or of all processes."""

    def __init__(self, lock: threading.RLock) -> None:
        """`lock` is the bus's own, and one that its holder may take again.

        The garbage collector ends nodes in the middle of anything, so also while a table is changed or read: with a
        lock of its own each table would wait for itself, or for who holds the bus and waits for it.
        """
        self._lock = lock
        self._nodes: dict[NodeId, None] = {}
        self._owners: dict[Owner, dict[NodeId, None]] = {}
        self.publishers: Entities[Endpoint] = Entities("topic", lock)
        self.subscriptions: Entities[Endpoint] = Entities("topic", lock)
        self.servers: Entities[ServiceEndpoint] = Entities("name", lock)
        self.clients: Entities[ClientEndpoint] = Entities("name", lock)

    def add_node(self, node: NodeId) -> None:
        """A node has come."""
        with self._lock:
            self._nodes[node] = None
            _put(self._owners, node.owner, node)

    def remove_node(self, node: NodeId) -> None:
        """A node has gone; a second time does nothing."""
        with self._lock:
            self._nodes.pop(node, None)
            _drop(self._owners, node.owner, node)

    def nodes(self) -> Sequence[NodeId]:
        """All nodes, in the order in which they came."""
        with self._lock:
            return [*self._nodes.copy()]

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


def _put(table: dict[K, dict[E, None]], key: K, entry: E) -> None:
    """Put an entry into its row; whatever is removed meanwhile, by the same thread, the row is in the table then."""
    row = table.get(key, {})
    row[entry] = None
    table[key] = row


def _drop(table: dict[K, dict[E, None]], key: K, entry: E) -> None:
    """Take an entry out of its row, and an empty row out of the table."""
    row = table.get(key, {})
    row.pop(entry, None)
    if not row:
        table.pop(key, None)
