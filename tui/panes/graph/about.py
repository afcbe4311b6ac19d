"""One-line descriptions of nodes, topics, services and actions. Pure."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bot_console.tui.console.graph.anomalies import SILENT, debugger_text
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.namespaces import ACTION, SERVICE, SPACE, TOPIC
from bot_console.tui.panes.transitions import state_text
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize


def summary(info: GraphInfo, item: str, hides_name: Callable[[str], bool]) -> str:
    """Describe an item in one line; of a node's topics, those that `hides_name` hides are counted separately."""
    if not item:
        return ""
    if item.startswith(SPACE):
        return sanitize(f"{item.removeprefix(SPACE)}  enter or + unfolds it")
    if item.startswith((SERVICE, ACTION)):
        kind, _, name = item.partition(":")
        return sanitize(f"{kind} {name}  {' '.join(server_types(info, item))}")
    if item.startswith(TOPIC):
        name = item.removeprefix(TOPIC)
        publishers, subscribers = nodes_on_topic(info, name)
        kinds = topic_types(info, name)
        text = f"{name}  {', '.join(kinds) or 'type unknown'}  {counted(len(publishers), 'publisher')}"
        return sanitize(f"{text}, {counted(len(subscribers), 'subscription')}{warning(publishers, subscribers)}")
    node = node_of(info, item)
    if node is None:
        return ""
    parts = [f"publishes {_number(node.publishers, hides_name)}"]
    parts += [f"subscribes to {_number(node.subscriptions, hides_name)}"]
    parts += [f"{counted(len(node.services), 'service')}", f"{counted(len(node.clients), 'client')}"]
    stopped = "".join(f" - frozen: process {pid} is stopped" for name, pid in info.frozen if name == item)
    stopped = stopped or "".join(f" - {debugger_text(line)}" for name, line in info.debugged if name == item)
    stopped = stopped or (f" - {SILENT}" if item in info.silent else "")
    state = f"{state_text(info.lifecycle[item])}, " if item in info.lifecycle else ""
    return sanitize(f"{item}  {state}{', '.join(parts)}{stopped}")


def _number(ends: Sequence[Endpoint], hides_name: Callable[[str], bool]) -> str:
    hidden = sum(hides_name(each.name) for each in ends)
    return f"{len(ends) - hidden} + {hidden} hidden" if hidden else str(len(ends))


def server_types(info: GraphInfo, item: str) -> list[str]:
    """The types of a service or action, followed by a text that names its servers."""
    kind, _, name = item.partition(":")
    found: dict[str, None] = {}
    servers: list[str] = []
    for node in info.nodes:
        for each in node.services if kind == "service" else node.action_servers:
            if each.name == name:
                found.update(dict.fromkeys(each.types))
                servers.append(node.name)
    return [*found, "served by " + (", ".join(servers) or "nobody")]


def warning(publishers: list[str], subscribers: list[str]) -> str:
    """A remark on a topic that lacks publishers or subscribers; otherwise empty."""
    if not publishers:
        return " - nobody publishes it: is the name right?"
    return " - no subscriber" if not subscribers else ""


def nodes_on_topic(info: GraphInfo, topic: str) -> tuple[list[str], list[str]]:
    """The nodes that publish and that subscribe to a topic."""
    publishers = [node.name for node in info.nodes if any(each.name == topic for each in node.publishers)]
    subscribers = [node.name for node in info.nodes if any(each.name == topic for each in node.subscriptions)]
    return publishers, subscribers


def topic_types(info: GraphInfo, topic: str) -> tuple[str, ...]:
    """The types of a topic; more than one is an error in the system."""
    found: dict[str, None] = {}
    every: list[Endpoint] = [*info.topics]
    for node in info.nodes:
        every += [*node.publishers, *node.subscriptions]
    for each in every:
        if each.name == topic:
            found.update(dict.fromkeys(each.types))
    return tuple(found)


def node_of(info: GraphInfo, name: str) -> NodeInfo | None:
    """The node with this name, or None."""
    return next((each for each in info.nodes if each.name == name), None)
