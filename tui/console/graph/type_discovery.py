"""Requests the definitions of types that this program lacks from the nodes that use them."""

from __future__ import annotations

import importlib.util
from collections import deque
from collections.abc import Callable, Generator, Iterator, Mapping
from typing import Any, Protocol

from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.model import GraphInfo
from rclpy.node import Node

FOLDERS = ("msg", "srv", "action")

Inquiry = Generator[tuple[str, str], Any, str]
"""The dialogue with one node about a type.

Yields a type and its hash for each request to the node's `get_type_description`, and receives the response. Returns why
the type is unavailable, as a phrase about the node, or an empty text once the type can be imported.
"""


class TypeSource(Protocol):
    """A service that rclpy lacks: finds the hashes of unknown types, and builds interfaces from their definitions."""

    def inquiries(self, domain: int, type_name: str) -> Mapping[str, Inquiry]:
        """The dialogues about a type, by the nodes that can be asked."""
        ...


class TypeDiscovery:
    """Requests each unknown type once, one at a time, and calls `learned` after each new one.

    All methods except `explain` are called by the executor's thread.
    """

    def __init__(self, node: Node, calls: Calls, source: TypeSource | None, learned: Callable[[], None]) -> None:
        """Without a `source`, as where ROS itself is installed, nothing is requested."""
        self._node = node
        self._calls = calls
        self._source = source
        self._learned = learned
        self._here: set[str] = set()
        """Types that this program has, so that they need not be requested."""
        self._missing: set[str] = set()
        """Packages that were missing when first encountered, even if some of their types have been learned since."""
        self._asked: set[tuple[str, str]] = set()
        """Types already requested, each with the node that was asked, until that node leaves."""
        self._waiting: deque[str] = deque()
        """Types still to be requested."""
        self._busy = False
        self._why: dict[str, str] = {}

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph: there may be new unknown types, or nodes that have not been asked yet."""
        if self._source is None:
            return
        nodes = {each.name for each in graph.nodes}
        self._asked = {each for each in self._asked if each[1] in nodes}
        for type_name in dict.fromkeys(_used_types(graph)):
            if type_name not in self._waiting and not self._is_available(type_name):
                self._waiting.append(type_name)
        if self._waiting and not self._busy:
            self._busy = True
            self._calls.run(self._ask_all)

    def explain(self, type_name: str, otherwise: str) -> str:
        """Why a requested type is still unknown; the text `otherwise` if it was not requested. From any thread."""
        why = self._why.get(type_name)
        return f"the type {type_name} is not known here: {why}" if why else otherwise

    def _is_available(self, type_name: str) -> bool:
        if type_name not in self._here:
            package, _, rest = type_name.partition("/")
            if package not in self._missing and importlib.util.find_spec(package) is None:
                self._missing.add(package)
            if rest.partition("/")[0] not in FOLDERS or package not in self._missing:
                self._here.add(type_name)
        return type_name in self._here

    async def _ask_all(self) -> None:
        try:
            while self._waiting:
                await self._ask_nodes(self._waiting[0])
                self._waiting.popleft()
        finally:
            self._busy = False

    async def _ask_nodes(self, type_name: str) -> None:
        assert self._source is not None
        for node, inquiry in self._source.inquiries(self._node.context.get_domain_id(), type_name).items():
            if (type_name, node) in self._asked:
                continue
            self._asked.add((type_name, node))
            problem = await self._ask(node, inquiry)
            if not problem:
                self._why.pop(type_name, None)
                self._here.add(type_name)
                self._learned()
                return
            self._why[type_name] = f"{node} {problem}"

    async def _ask(self, node: str, inquiry: Inquiry) -> str:
        """Send all requests of an inquiry to a node; returns why the answer is unusable, or an empty text."""
        from type_description_interfaces.srv import GetTypeDescription

        service = f"{node}/get_type_description"
        try:
            type_name, type_hash = next(inquiry)
            while True:
                request = GetTypeDescription.Request(
                    type_name=type_name, type_hash=type_hash, include_type_sources=True
                )
                type_name, type_hash = inquiry.send(await self._calls.ask(GetTypeDescription, service, request))
        except NoAnswer as error:
            return f"does not describe it: {error}"
        except StopIteration as over:
            return over.value
        finally:
            self._calls.forget(service)


def _used_types(graph: GraphInfo) -> Iterator[str]:
    """The types of topics and services; for the parts of an action, the action."""
    for each in (*graph.topics, *graph.services):
        for type_name in each.types:
            package, _, rest = type_name.partition("/action/")
            yield f"{package}/action/{rest.partition('_')[0]}" if rest else type_name
