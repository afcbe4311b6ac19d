"""Types of topics and services that this program does not have: asked from the nodes that use them."""

from __future__ import annotations

import importlib.util
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Protocol

from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.graph.full_name import name_of
from bot_console.tui.console.model import GraphInfo
from rclpy.node import Node

FOLDERS = ("msg", "srv")
"""Of which types a node can tell the definition; what an action is made of has none of its own."""


class TypeSource(Protocol):
    """What rclpy cannot do: make an interface from its definition, and tell which hash the type of a service has."""

    def service_hashes(self, domain: int, service: str) -> Mapping[str, str]:
        """The hashes of the type of a service, by the nodes that offer it."""
        ...

    def learn(self, type_name: str, type_hash: str, told: Any) -> str:
        """Take a response of `get_type_description`; why that cannot be, as said of the node, else empty."""
        ...


class ToldTypes:
    """Asks for each type once, one after the other, and tells `learned` when there is one more.

    The executor's thread calls all methods but `explain`.
    """

    def __init__(self, node: Node, calls: Calls, source: TypeSource | None, learned: Callable[[], None]) -> None:
        """Without a `source` nothing is asked, as where ROS itself is installed."""
        self._node = node
        self._calls = calls
        self._source = source
        self._learned = learned
        self._here: set[str] = set()
        """Types of packages that this program has; none of them is ever asked for."""
        self._asked: set[tuple[str, str]] = set()
        """Types and the nodes that were asked for them, as long as they are there."""
        self._waiting: deque[tuple[str, str]] = deque()
        """Types to be asked for, each with a topic or service that has it."""
        self._busy = False
        self._why: dict[str, str] = {}

    def follow(self, graph: GraphInfo) -> None:
        """The graph is another: there may be types that nobody here has, or nodes that were not asked yet."""
        if self._source is None:
            return
        nodes = {each.name for each in graph.nodes}
        self._asked = {each for each in self._asked if each[1] in nodes}
        known = dict(self._waiting)
        for name, type_name in _used(graph):
            if type_name not in known and not self._is_here(type_name):
                known[type_name] = name
                self._waiting.append((type_name, name))
        if self._waiting and not self._busy:
            self._busy = True
            self._calls.run(self._ask_all(), lambda why: None)

    def explain(self, type_name: str, otherwise: str) -> str:
        """Why a type is not known here, where it was asked for, and else another text; from any thread."""
        why = self._why.get(type_name)
        return f"the type {type_name} is not known here: {why}" if why else otherwise

    def _is_here(self, type_name: str) -> bool:
        if type_name not in self._here:
            package, _, rest = type_name.partition("/")
            if rest.partition("/")[0] not in FOLDERS or importlib.util.find_spec(package) is not None:
                self._here.add(type_name)
        return type_name in self._here

    async def _ask_all(self) -> None:
        try:
            while self._waiting:
                type_name, name = self._waiting[0]
                await self._ask_nodes(type_name, name)
                self._waiting.popleft()
        finally:
            self._busy = False

    async def _ask_nodes(self, type_name: str, name: str) -> None:
        for node, type_hash in sorted(self._hashes(type_name, name).items()):
            if (type_name, node) in self._asked:
                continue
            self._asked.add((type_name, node))
            problem = await self._ask(node, type_name, type_hash)
            if not problem:
                self._why.pop(type_name, None)
                self._here.add(type_name)
                self._learned()
                return
            self._why[type_name] = f"{node} {problem}"

    def _hashes(self, type_name: str, name: str) -> Mapping[str, str]:
        """Whom to ask for a type, and which hash it has there."""
        if "/srv/" in type_name:
            assert self._source is not None
            return self._source.service_hashes(self._node.context.get_domain_id(), name)
        node = self._node
        found = [*node.get_subscriptions_info_by_topic(name), *node.get_publishers_info_by_topic(name)]
        return {name_of(each): str(each.topic_type_hash) for each in found if each.topic_type == type_name}

    async def _ask(self, node: str, type_name: str, type_hash: str) -> str:
        """Ask a node; why it is no use, else empty."""
        from type_description_interfaces.srv import GetTypeDescription

        assert self._source is not None
        service = f"{node}/get_type_description"
        request = GetTypeDescription.Request(type_name=type_name, type_hash=type_hash, include_type_sources=True)
        try:
            told = await self._calls.ask(GetTypeDescription, service, request)
        except NoAnswer as error:
            return f"does not describe it: {error}"
        finally:
            self._calls.forget(service)
        return self._source.learn(type_name, type_hash, told)


def _used(graph: GraphInfo) -> Iterator[tuple[str, str]]:
    for each in (*graph.topics, *graph.services):
        for type_name in each.types:
            yield each.name, type_name
