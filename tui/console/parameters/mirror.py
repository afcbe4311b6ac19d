"""Mirrors the parameters of all nodes: read once by service, then kept up to date from `/parameter_events`."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any

from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.model import (
    ChangeSource,
    GraphInfo,
    Kind,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
    Value,
    parameter_in,
    same,
)
from bot_console.tui.console.parameters.origin_text import START, origin_text
from bot_console.tui.console.parameters.provenance import Provenance
from bot_console.tui.console.values import from_message, info
from bot_console.tui.text.natural import natural_key
from rcl_interfaces.msg import Parameter, ParameterEvent, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters
from rclpy.node import Node
from rclpy.qos import qos_profile_parameter_events

RELIST_S = 5.0
"""Seconds between checks for what no event has reported: undeclared parameters, and the values of a node that restarted
before its absence was noticed and whose first event was lost.
"""

Reading = Callable[[str], Coroutine[Any, Any, None]]
"""A coroutine that queries a node."""

MAX_CONCURRENT_QUERIES = 16
"""The number of nodes queried at the same time. If all were queried at once, the nodes of a busy machine would respond
too late.
"""

Changed = Callable[[str, str, Value, Value], ChangeSource]
OnRestart = Callable[[str, str, Value, Value], object]

MAX_DEPARTED_NODES = 500
"""The number of departed nodes whose values are kept, so that differences are noticed when they come back."""


class ParameterMirror:
    """The parameters of each node that offers the parameter services.

    `changed(node, name, old, new)` is called for each value that an event reports, even an equal one, but never for a
    value that is read for the first time; it returns the source of the change. `on_restart(node, name, old, new)` is
    called instead if a node has restarted with another value than before, which nobody has set.
    """

    def __init__(
        self,
        node: Node,
        calls: Calls,
        changed: Changed,
        provenance: Provenance | None = None,
        on_restart: OnRestart = lambda node, name, old, new: None,
    ) -> None:
        self._provenance = provenance or Provenance()
        self.trees: Mapping[str, ParameterTree] = MappingProxyType({})
        self._calls = calls
        self._changed = changed
        self._on_restart = on_restart
        self._left: dict[str, ParameterTree] = {}
        self._unreported: dict[tuple[str, str], Value] = {}
        """Values, by node and parameter, that were replaced by newly read ones which no event has reported yet."""
        self._copies: dict[str, int] = {}
        self._offering: set[str] = set()
        self._loading: set[str] = set()
        self._waiting: deque[tuple[Reading, str]] = deque()
        self._reading = 0
        node.create_subscription(ParameterEvent, "/parameter_events", self._on_event, qos_profile_parameter_events)
        node.create_timer(RELIST_S, self._poll_again)

    def get(self, node: str, name: str) -> ParameterInfo | None:
        """The last known state of a parameter; None if it is unknown."""
        return parameter_in(self.trees, node, name)

    def follow(self, graph: GraphInfo) -> None:
        """Query nodes that have appeared, and forget nodes that have left.

        If several nodes have the same name, it is unknown whose values are shown: when one leaves, the others are read
        as if they were new.
        """
        self._offering = offering = {node.name for node in graph.nodes if _offers(node, f"{node.name}/list_parameters")}
        before, self._copies = self._copies, {node.name: node.copies for node in graph.nodes}
        gone = {name for name in self.trees if name not in offering or self._copies[name] < before.get(name, 1)}
        if gone:
            self._left |= {name: self.trees[name] for name in gone if self.trees[name].parameters}
            while len(self._left) > MAX_DEPARTED_NODES:
                del self._left[next(iter(self._left))]
            self._publish({name: tree for name, tree in self.trees.items() if name not in gone})
            for name in gone:
                self._calls.forget(name + "/")
        for name in offering - self.trees.keys():
            self._load(name)

    def _publish(self, trees: dict[str, ParameterTree]) -> None:
        self.trees = MappingProxyType(dict(sorted(trees.items(), key=lambda each: natural_key(each[0]))))

    def _load(self, node: str) -> None:
        self._queue(self._read, node)

    def _queue(self, reading: Reading, node: str) -> None:
        """Query a node once fewer than `MAX_CONCURRENT_QUERIES` are being queried, unless it is already queued."""
        if node not in self._loading:
            self._loading.add(node)
            self._waiting.append((reading, node))
            self._fill_window()

    def _fill_window(self) -> None:
        while self._waiting and self._reading < MAX_CONCURRENT_QUERIES:
            self._reading += 1
            self._calls.run(partial(self._in_window, *self._waiting.popleft()))

    async def _in_window(self, reading: Reading, node: str) -> None:
        try:
            if node in self._offering:  # else it has left while it was queued
                await reading(node)
        finally:
            self._loading.discard(node)
            self._reading -= 1
            self._fill_window()

    async def _read(self, node: str) -> None:
        try:
            listed = await self._calls.ask(ListParameters, f"{node}/list_parameters", ListParameters.Request())
            names = list(listed.result.names)
            found = await self._describe(node, names)
            tree = ParameterTree(node, tuple(found))
        except NoAnswer as error:
            old = self.trees.get(node)
            tree = ParameterTree(node, old.parameters if old else (), str(error))
        if node in self._offering:  # else it has left in the meantime
            known = self.trees.get(node)
            self._publish({**self.trees, node: tree})
            if not tree.problem:
                self._note_unreported(tree, known)
                self._compare(tree, self._left.pop(node, None))

    def _note_unreported(self, tree: ParameterTree, before: ParameterTree | None) -> None:
        """Keep the old value of each parameter that has changed without an event: the event may still be on its way."""
        for each in tree.parameters:
            old = before.get(each.name) if before else None
            self._unreported.pop((each.node, each.name), None)
            if old is not None and old.value is not None and not same(old.value, each.value):
                self._unreported[each.node, each.name] = old.value

    def _compare(self, tree: ParameterTree, before: ParameterTree | None) -> None:
        """Report each value that differs from the one that the node had when it left."""
        for each in tree.parameters:
            old = before.get(each.name) if before else None
            if old is not None and not same(old.value, each.value):
                self._on_restart(each.node, each.name, old.value, each.value)

    async def _describe(self, node: str, names: Sequence[str]) -> list[ParameterInfo]:
        if not names:
            return []
        request = DescribeParameters.Request(names=list(names))
        described = await self._calls.ask(DescribeParameters, f"{node}/describe_parameters", request)
        values = await self._values(node, names)
        before = None if node in self._left else self.trees.get(node)  # A restarted node gets a new start value.
        return [
            self._provenance.applied(info(node, value, descriptor, before.get(descriptor.name) if before else None))
            for descriptor, value in zip(described.descriptors, values, strict=False)
        ]

    async def _values(self, node: str, names: Sequence[str]) -> list[ParameterValue]:
        """Read values. An uninitialised one empties the whole response, so in that case they are read one by one."""
        service = f"{node}/get_parameters"
        answer = await self._calls.ask(GetParameters, service, GetParameters.Request(names=list(names)))
        if len(answer.values) == len(names):
            return list(answer.values)
        values: list[ParameterValue] = []
        for name in names:
            single = await self._calls.ask(GetParameters, service, GetParameters.Request(names=[name]))
            values.append(single.values[0] if single.values else ParameterValue())
        return values

    async def refresh(self, node: str) -> None:
        """Apply what was learned about the origin of a node's values; runs in the executor."""
        tree = self.trees.get(node)
        if tree is not None:
            reported = tuple(self._provenance.applied(each) for each in tree.parameters)
            if reported != tree.parameters:
                self._publish({**self.trees, node: replace(tree, parameters=reported)})

    def _poll_again(self) -> None:
        if self._waiting:
            return  # nodes that have not been read yet come first
        for node in self.trees:
            self._queue(self._relist, node)

    async def _relist(self, node: str) -> None:
        """Read a node again if its names or values differ from the known ones, or if it could not be read before."""
        differs = False
        try:
            listed = await self._calls.ask(ListParameters, f"{node}/list_parameters", ListParameters.Request())
            tree = self.trees.get(node)
            stale = (
                tree is None
                or bool(tree.problem)
                or {each.name for each in tree.parameters} != set(listed.result.names)
            )
            differs = not stale and await self._differs(node, list(listed.result.names))
        except NoAnswer as error:
            stale = False
            if node in self.trees and not self.trees[node].problem:
                self._publish({**self.trees, node: replace(self.trees[node], problem=str(error))})
        before = self.trees.get(node)
        if before is not None and (stale or differs):
            if differs:
                self._left[node] = before
            await self._read(node)
        else:
            self._unreported = {each: value for each, value in self._unreported.items() if each[0] != node}

    async def _differs(self, node: str, names: Sequence[str]) -> bool:
        """Whether two readings agree on an unreported value. After a single one, its event may still be on its way."""
        wrong: dict[str, Value] | None = None
        for _ in range(2):
            tree = self.trees.get(node)
            if not names or tree is None or any(each.value is None for each in tree.parameters):
                return False  # Uninitialised parameters would have to be read one by one.
            values = await self._values(node, names)
            known = {each.name: each.value for each in self.trees.get(node, tree).parameters}
            read = {name: from_message(value) for name, value in zip(names, values, strict=False)}
            wrong = {
                name: value
                for name, value in read.items()
                if not same(value, known.get(name)) and (wrong is None or same(value, wrong.get(name)))
            }
            if not wrong:
                return False
        return True

    def _on_event(self, event: ParameterEvent) -> None:
        tree = self.trees.get(event.node)
        if tree is None:
            return
        deleted = {each.name for each in event.deleted_parameters}
        known = {each.name: each for each in tree.parameters if each.name not in deleted}
        unknown = False
        for message in event.new_parameters:
            before = known.get(message.name)
            # the first value of a parameter that was declared without one
            if before is not None and before.value is None:
                known[message.name] = self._on_changed(before, message)
                continue
            unknown = True  # its description may have changed as well, if the program was edited and restarted
            if before is not None:
                known[message.name] = self._restarted(before, message)
        for message in event.changed_parameters:
            before = known.get(message.name)
            if before is None:
                unknown = True
            else:
                known[message.name] = self._on_changed(before, message)
        for name in deleted & {each.name for each in tree.parameters}:
            self._changed(event.node, name, getattr(tree.get(name), "value", None), None)
        self._publish({**self.trees, event.node: replace(tree, parameters=tuple(known.values()))})
        if unknown:
            self._load(event.node)

    def _on_changed(self, before: ParameterInfo, message: Parameter) -> ParameterInfo:
        value = from_message(message.value)
        kind = Kind(message.value.type) if message.value.type else before.kind
        unreported = self._unreported.pop((before.node, before.name), before.value)
        old = unreported if same(value, before.value) else before.value
        # An equal value is reported too, because the request that set it waits for its event.
        source = self._changed(before.node, before.name, old, value)
        if same(value, old) and kind is before.kind:
            return before
        return replace(before, value=value, kind=kind, origin=origin_text(source, time.time_ns()))

    def _restarted(self, before: ParameterInfo, message: Parameter) -> ParameterInfo:
        """Process a parameter that was declared again: the node restarted before its absence was noticed."""
        value = from_message(message.value)
        if not same(value, before.value):
            self._on_restart(before.node, before.name, before.value, value)
        kind = Kind(message.value.type) if message.value.type else before.kind
        first = replace(before, value=value, kind=kind, default=value, origin=START, declared_at="")
        return self._provenance.applied(first)


def _offers(node: NodeInfo, service: str) -> bool:
    return any(each.name == service for each in node.services)
