"""The graph of a bus by node, topic and service: each question costs what its answer holds, not the whole graph."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Sequence
from typing import Generic, TypeVar
from weakref import WeakKeyDictionary

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.endpoints import ClientEndpoint, Endpoint, ServiceEndpoint

NamesAndTypes = list[tuple[str, list[str]]]
Owner = tuple[str, str]
"""Name and namespace of a node. Two nodes may have the same, and are then asked about as one."""

T = TypeVar("T", Endpoint, ServiceEndpoint, ClientEndpoint)


class Entities(Generic[T]):
    """All publishers, subscriptions, servers or clients; `what` names the field that says of which topic or service."""

    def __init__(self, entities: Iterable[T], what: str) -> None:
        self.named: dict[str, list[T]] = {}
        self._owned: dict[Owner, list[tuple[str, str]]] = {}
        for each in entities:
            name, node = getattr(each, what), each.node
            self.named.setdefault(name, []).append(each)
            self._owned.setdefault((node.name, node.namespace), []).append((name, each.type_name))

    def on(self, name: str) -> Sequence[T]:
        """Those of a topic or service."""
        return self.named.get(name, ())

    def of(self, owner: Owner) -> NamesAndTypes:
        """Names, sorted, and types of what a node has."""
        return collect(self._owned.get(owner, ()))


class Tables:
    """What a bus has had at one moment."""

    def __init__(self, bus: Bus) -> None:
        self.nodes = {(each.name, each.namespace) for each in bus.nodes()}
        self.publishers = Entities(bus.publishers(), "topic")
        self.subscriptions = Entities(bus.subscriptions(), "topic")
        self.servers = Entities(bus.servers(), "name")
        self.clients = Entities(bus.clients(), "name")


class GraphIndex:
    """Keeps the tables of a bus until its graph changes."""

    def __init__(self) -> None:
        self._change = self._seen = object()
        self._tables: Tables | None = None

    def changed(self) -> None:
        """The graph has changed: what is kept holds no longer."""
        self._change = object()

    def tables(self, bus: Bus) -> Tables:
        """What the bus has now."""
        change, tables = self._change, self._tables
        if tables is None or change is not self._seen:
            tables = Tables(bus)
            # Noted as of before they were made: a change meanwhile makes them anew.
            self._tables, self._seen = tables, change
        return tables


def collect(pairs: Iterable[tuple[str, str]]) -> NamesAndTypes:
    """Pairs of a name and a type as sorted names with their sorted types."""
    found: dict[str, list[str]] = {}
    for name, kind in pairs:
        kinds = found.setdefault(name, [])
        if kind not in kinds:
            kinds.append(kind)
    return [(name, sorted(found[name])) for name in sorted(found)]


_indexes: WeakKeyDictionary[Bus, GraphIndex] = WeakKeyDictionary()
_lock = threading.Lock()


def tables_of(bus: Bus) -> Tables:
    """What a bus has now, by node, topic and service."""
    with _lock:
        index = _indexes.get(bus)
        if index is None:
            index = _indexes[bus] = GraphIndex()
            bus.on_graph_change(index.changed)
    return index.tables(bus)
