"""Finds and describes anomalies of a ROS graph that a person would look for in its picture. Standard library only."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.text.natural import natural_key

SHARED = ("/rosout", "/parameter_events", "/tf", "/tf_static", "/diagnostics", "/clock", "/statistics")
"""Topics that may have many publishers, or none, in a healthy graph."""

ON_OCCASION = ("/initialpose", "/emergency_stop/request", "/emergency_stop/arbiter")
"""Suffixes of topics that usually have subscriptions but no publisher: a person or a safety monitor publishes when
necessary.
"""

SILENT = "has not answered for a second: it was killed, it hangs, or it is busy"


@dataclass(frozen=True)
class GraphFinding:
    """An anomaly: the topic, service, action or node, what is unusual, and whether it is certainly wrong."""

    subject: str
    text: str
    fault: bool = False


def findings(info: GraphInfo) -> tuple[GraphFinding, ...]:
    """All anomalies: faults first, then by subject. Hidden nodes and topics are left out."""
    nodes = [each for each in info.nodes if not each.hidden]
    visible = replace(info, nodes=tuple(nodes))
    otherwise = (GraphFinding(each.partition(": ")[0], each, True) for each in info.unheard)
    frozen = (GraphFinding(node, f"{node} is frozen: {resume_hint(pid)}", True) for node, pid in info.frozen)
    silent = (GraphFinding(node, f"{node} {SILENT}", True) for node in info.silent)
    debugged = (GraphFinding(node, f"{node} is {debugger_text(line)}") for node, line in info.debugged)
    found = [*_duplicate_names(nodes), *_topics(visible), *_services(nodes), *_isolated_nodes(nodes)]
    found += [*otherwise, *frozen, *silent, *debugged]
    return tuple(sorted(found, key=lambda each: (not each.fault, natural_key(each.subject))))


def debugger_text(line: str) -> str:
    """A text saying that a node is stopped in a debugger, and at which line if known."""
    return f"stopped in debugger at {line}" if line else "stopped in debugger"


def resume_hint(pid: int) -> str:
    """A text saying that a process is stopped, and how to resume it."""
    return f"process {pid} is stopped; `kill -CONT {pid}` resumes it"


def _topics(info: GraphInfo) -> Iterator[GraphFinding]:
    publishers = _endpoints_by_name(info.nodes, "publishers")
    subscribers = _endpoints_by_name(info.nodes, "subscriptions")
    for topic in sorted(publishers.keys() | subscribers.keys()):
        if "/_" in topic:
            continue
        gives, takes = publishers.get(topic, {}), subscribers.get(topic, {})
        types = {each for end in (*gives.values(), *takes.values()) for each in end.types}
        if len(types) > 1:
            yield GraphFinding(
                topic, f"{topic} has different types, so no messages pass between them: {_list(types)}", True
            )
        for publisher, subscriber, why in info.incompatible.get(topic, ()):
            yield GraphFinding(topic, f"{topic}: nothing arrives from {publisher} at {subscriber}: {why}", True)
        if topic in SHARED:
            continue
        if takes and not gives and not topic.endswith(ON_OCCASION):
            yield GraphFinding(topic, f"nobody publishes {topic}, which {_list(takes)} {_listens(takes)} to")
        if len(gives) > 1:
            yield GraphFinding(topic, f"{_number(len(gives))} publishers on {topic}: {_list(gives)}")


def _services(nodes: list[NodeInfo]) -> Iterator[GraphFinding]:
    for given, taken, what in (("services", "clients", "serves"), ("action_servers", "action_clients", "executes")):
        gives, takes = _endpoints_by_name(nodes, given), _endpoints_by_name(nodes, taken)
        for name in sorted(takes.keys() - gives.keys()):
            yield GraphFinding(name, f"nobody {what} {name}, which {_list(takes[name])} asks for", True)
        for name in sorted(each for each, servers in gives.items() if len(servers) > 1):
            yield GraphFinding(name, f"{_number(len(gives[name]))} servers of {name}: {_list(gives[name])}", True)


def _isolated_nodes(nodes: list[NodeInfo]) -> Iterator[GraphFinding]:
    for node in nodes:
        ends = (*node.publishers, *node.subscriptions, *node.clients, *node.action_servers, *node.action_clients)
        services = [each for each in node.services if not each.name.startswith(f"{node.name}/")]
        if not services and all(each.name in SHARED for each in ends):
            yield GraphFinding(node.name, f"{node.name} publishes, subscribes to and serves nothing")


def _duplicate_names(nodes: list[NodeInfo]) -> Iterator[GraphFinding]:
    for node in nodes:
        if node.copies > 1:
            yield GraphFinding(node.name, duplicate_name_text(node), True)


def duplicate_name_text(node: NodeInfo) -> str:
    """A message saying that several nodes share this name, and what follows from it."""
    return (
        f"{_number(node.copies)} nodes are called {node.name}: values shown and set may belong to any of them; "
        "is one still running in another terminal?"
    )


def _endpoints_by_name(nodes: list[NodeInfo] | tuple[NodeInfo, ...], kind: str) -> dict[str, dict[str, Endpoint]]:
    """The endpoints of one kind, by name and then by node."""
    found: dict[str, dict[str, Endpoint]] = {}
    for node in nodes:
        ends: tuple[Endpoint, ...] = getattr(node, kind)
        for each in ends:
            found.setdefault(each.name, {})[node.name] = each
    return found


def _list(names: Iterable[str]) -> str:
    words = sorted(names)
    return ", ".join(words[:4]) + (f" and {len(words) - 4} more" if len(words) > 4 else "")


def _listens(nodes: dict[str, Endpoint]) -> str:
    return "listens" if len(nodes) == 1 else "listen"


def _number(count: int) -> str:
    return {2: "two", 3: "three", 4: "four"}.get(count, str(count))
