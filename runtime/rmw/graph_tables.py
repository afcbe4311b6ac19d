"""The graph indexed by node, topic and service, updated incrementally: the cost of a query grows only with its answer.

Rebuilding it at each change would be quadratic: while hundreds of nodes start, queries and changes alternate.
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
    """All publishers, subscriptions, servers or clients. Thread-safe."""

    def __init__(self, what: str, lock: threading.RLock) -> None:
        """`what` is the name of the field that holds an entity's topic or service."""
        self._what = what
        self._lock = lock
        # Each in order of arrival.
        self._by_name: dict[str, dict[T, None]] = {}
        self._by_owner: dict[Owner, dict[T, None]] = {}
        self._by_name_and_type: dict[tuple[str, str], dict[T, None]] = {}

    def add(self, entity: T) -> None:
        """Add an entity; does nothing if it is already there."""
        name, kind = getattr(entity, self._what), entity.type_name
        with self._lock:
            _put(self._by_name, name, entity)
            _put(self._by_owner, entity.node.owner, entity)
            _put(self._by_name_and_type, (name, kind), entity)

    def remove(self, entity: T) -> None:
        """Remove an entity; does nothing if it is not there."""
        name, kind = getattr(entity, self._what), entity.type_name
        with self._lock:
            _drop(self._by_name, name, entity)
            _drop(self._by_owner, entity.node.owner, entity)
            _drop(self._by_name_and_type, (name, kind), entity)

    def on(self, name: str) -> Sequence[T]:
        """Return the entities of a topic or service."""
        with self._lock:
            return [*self._by_name.get(name, {}).copy()]

    def of(self, owner: Owner) -> Iterable[tuple[str, str]]:
        """Return the names and types of a node's entities."""
        with self._lock:
            owned = self._by_owner.get(owner, {}).copy()
        return [(getattr(each, self._what), each.type_name) for each in owned]

    def pairs(self) -> Iterable[tuple[str, str]]:
        """Return all distinct pairs of a name and a type."""
        with self._lock:
            return [*self._by_name_and_type.copy()]

    def all(self) -> Sequence[T]:
        """Return all entities, grouped by name."""
        with self._lock:
            named = self._by_name.copy()
        return [each for row in named.values() for each in row.copy()]


class GraphTables:
    """The graph entries of one process, or of all others."""

    def __init__(self, lock: threading.RLock) -> None:
        """`lock` is the bus's own reentrant lock.

        The garbage collector may end a node at any point, including while a table is being changed or read: with
        separate locks, a table could deadlock with itself, or with a thread that holds the bus's lock and waits for the
        table's.
        """
        self._lock = lock
        self._nodes: dict[NodeId, None] = {}
        self._owners: dict[Owner, dict[NodeId, None]] = {}
        self.publishers: Entities[Endpoint] = Entities("topic", lock)
        self.subscriptions: Entities[Endpoint] = Entities("topic", lock)
        self.servers: Entities[ServiceEndpoint] = Entities("name", lock)
        self.clients: Entities[ClientEndpoint] = Entities("name", lock)

    def add_node(self, node: NodeId) -> None:
        """Add a node."""
        with self._lock:
            self._nodes[node] = None
            _put(self._owners, node.owner, node)

    def remove_node(self, node: NodeId) -> None:
        """Remove a node; does nothing if it is not there."""
        with self._lock:
            self._nodes.pop(node, None)
            _drop(self._owners, node.owner, node)

    def nodes(self) -> Sequence[NodeId]:
        """Return all nodes, in order of arrival."""
        with self._lock:
            return [*self._nodes.copy()]

    def has(self, owner: Owner) -> bool:
        """Whether a node with this name and namespace exists."""
        return owner in self._owners


def collect(pairs: Iterable[tuple[str, str]]) -> NamesAndTypes:
    """Group pairs of a name and a type into sorted names with their sorted types."""
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
    """Add an entry to its row. The row is put back last, in case the same thread (in the garbage collector) has removed
    it meanwhile.
    """
    row = table.get(key, {})
    row[entry] = None
    table[key] = row


def _drop(table: dict[K, dict[E, None]], key: K, entry: E) -> None:
    """Remove an entry from its row, and an empty row from the table."""
    row = table.get(key, {})
    row.pop(entry, None)
    if not row:
        table.pop(key, None)
