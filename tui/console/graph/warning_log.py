"""Logs warnings about the graph: frozen nodes, duplicate node names, rival command publishers."""

from __future__ import annotations

import time
from collections.abc import Hashable, Iterator

from bot_console.tui.console.graph.anomalies import duplicate_name_text, resume_hint
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.model import GraphInfo, NodeInfo, Severity
from bot_console.tui.console.robot.command_topics import command_types_of

SOURCE = "bot-console"


class GraphWarnings:
    """Logs a warning when its condition arises, and again only after the condition has been over in the meantime."""

    def __init__(self, log: Add) -> None:
        self._log = log
        self._reported: frozenset[Hashable] = frozenset()

    def follow(self, graph: GraphInfo) -> None:
        """Log the warnings that apply to this graph but did not apply to the previous one."""
        found = dict(warnings(graph))
        for key, text in found.items():
            if key not in self._reported:
                self._log(time.time_ns(), Severity.WARN, SOURCE, text, ("", "", 0))
        self._reported = frozenset(found)


def warnings(graph: GraphInfo) -> Iterator[tuple[Hashable, str]]:
    """The warnings that apply to a graph, each with a unique key."""
    for node, pid in graph.frozen:
        yield ("frozen", node, pid), f"{node} is frozen: {resume_hint(pid)}"
    for node in graph.nodes:
        if node.copies > 1 and not node.hidden:
            yield ("namesakes", node.name), duplicate_name_text(node)
    for topic, nodes in _rivals(graph):
        yield ("rivals", topic, nodes), rivals_text(topic, nodes)


def rivals_text(topic: str, nodes: tuple[str, ...]) -> str:
    """A message saying that several nodes publish the same velocity topic, and what follows from it."""
    return (
        f"{topic} is published by {', '.join(nodes[:-1])} and {nodes[-1]}: the newest command wins, and the "
        "limits of one node do not apply to the others; stop one of them, or remap its topic"
    )


def _rivals(graph: GraphInfo) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Each velocity topic that has a subscription and several publishing nodes, with these nodes.

    Topics that only lifecycle nodes publish, like the servers of Nav2, are exempt: a manager makes them take turns.
    """
    nodes = [each for each in graph.nodes if not each.hidden]
    heard = {end.name for node in nodes for end in node.subscriptions}
    for topic in sorted(command_types_of(graph).keys() & heard):
        senders = [node for node in nodes if any(end.name == topic for end in node.publishers)]
        if len(senders) > 1 and not all(map(_has_lifecycle, senders)):
            yield topic, tuple(sorted(node.name for node in senders))


def _has_lifecycle(node: NodeInfo) -> bool:
    return any(end.name == f"{node.name}/change_state" for end in node.services)
