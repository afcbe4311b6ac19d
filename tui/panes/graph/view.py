"""Which part of the ROS graph is drawn: modes, filters and hidden topics, as in rqt_graph. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType

from bot_console.tui.console.graph.findings import SILENT
from bot_console.tui.console.graph.qos import mismatches
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.query import Query
from bot_console.tui.format import counted, harmless
from bot_console.tui.panes.graph.focus_history import Focus, around
from bot_console.tui.panes.graph.namespaces import SPACE, box_of, folded_edges
from bot_console.tui.widgets.diagram.graph import Digraph, Item

DEBUG_TOPICS = ("/rosout", "/parameter_events", "/statistics", "/rosout_agg", "/diagnostics_agg")
"""Topics of every node, and of tools: with them each drawing is a knot."""

TOPIC, SERVICE, ACTION = "topic:", "service:", "action:"
LINKS = (TOPIC, SERVICE, ACTION)
"""How the ids of items begin that stand between nodes."""
LONGEST, SHORT = 40, 16


class Mode(Enum):
    """What is drawn, in rqt_graph's terms."""

    ACTIVE = "nodes and topics in use"
    ALL = "nodes and all topics"
    NODES = "nodes only"


@dataclass(frozen=True)
class GraphView:
    """The user's choices for drawing the graph."""

    mode: Mode = Mode.ALL
    query: Query = field(default_factory=Query)
    debug: bool = False
    dead_sinks: bool = True
    leaves: bool = True
    services: bool = False
    """Whether services and actions are drawn, too."""
    folded: frozenset[str] = frozenset()
    """Namespaces that are drawn as one box."""
    focus: Focus = field(default_factory=Focus)
    short: bool = False
    """Whether names are cut to their last token."""
    whole: bool = False
    """Whether names are never cut, however long: in a file there is room."""


@dataclass(frozen=True)
class Shown:
    """The graph to draw, the topics without a publisher or a subscriber, and how much is omitted."""

    graph: Digraph
    dead_ends: frozenset[str] = frozenset()
    hidden: int = 0
    """Nodes and topics that are not drawn."""

    every: int = 0
    """Nodes and topics that there are."""

    faults: frozenset[tuple[str, str]] = frozenset()
    """Edges on which nothing arrives, since the QoS of their ends does not match."""

    silent: frozenset[str] = frozenset()
    """Nodes that do not answer, or whose process is frozen."""


def shown(info: GraphInfo, view: GraphView, rates: Mapping[str, str] = MappingProxyType({})) -> Shown:
    """Select nodes and topics, and convert them to items and edges; `rates` are appended to topic names."""
    nodes = [each for each in info.nodes if view.debug or not each.hidden]
    edges = _edges(nodes, view)
    topics = {TOPIC + each.name for each in info.topics} | {each for edge in edges for each in edge if is_link(each)}
    everything = len(nodes) + len(topics)
    kept = {each for each in topics if view.debug or not is_debug(each.partition(":")[2])}
    sources, sinks = {b for _, b in edges}, {a for a, _ in edges}
    dead_ends = frozenset(each for each in kept if each not in sources or each not in sinks)
    counts = Counter(each for edge in edges for each in edge)
    kept = {each for each in kept if _wanted(each, view, sources, sinks, counts)}
    ids = _filtered({each.name for each in nodes} | kept, edges, view.query)
    edges = [(a, b) for a, b in edges if a in ids and b in ids]
    faults = {
        (TOPIC + topic, subscriber)
        for topic in (each.removeprefix(TOPIC) for each in ids if each.startswith(TOPIC))
        for _, subscriber, _ in mismatches(info, topic)
    }
    hidden = everything - len(ids)
    if view.folded:
        drawn, inside = folded_edges(edges, view.folded, {each for each in ids if is_link(each)})
        edges = sorted(drawn)
        ids = {each if is_link(each) else box_of(each, view.folded) for each in ids - inside}
        faults = {(topic, box_of(node, view.folded)) for topic, node in faults if topic in ids}
    if view.focus.item:
        near = around(view.focus, edges)
        hidden += len(ids - near)
        ids &= near
        edges = [(a, b) for a, b in edges if a in ids and b in ids]
    silent = frozenset((*info.silent, *(name for name, _ in info.frozen)))
    if view.mode is Mode.NODES:
        graph = _nodes_only([each for each in ids if not is_link(each)], edges, _Labels(info, view, {}, ids, set()))
        return Shown(graph, hidden=hidden, every=everything, silent=silent)
    label = _Labels(info, view, rates, ids, {topic for topic, _ in faults})
    items = tuple(Item(each, label.of(each), not is_link(each), int(is_link(each))) for each in sorted(ids))
    graph = Digraph(items, tuple(sorted(edges)))
    return Shown(graph, dead_ends & ids, hidden, everything, frozenset(faults), silent)


def _edges(nodes: list[NodeInfo], view: GraphView) -> list[tuple[str, str]]:
    edges = [(node.name, TOPIC + each.name) for node in nodes for each in node.publishers]
    edges += [(TOPIC + each.name, node.name) for node in nodes for each in node.subscriptions]
    if not view.services:
        return edges
    asked = {each.name for node in nodes for each in node.clients}
    for node in nodes:
        own = f"{node.name}/"
        served = (each.name for each in node.services if each.name in asked or not each.name.startswith(own))
        edges += [(SERVICE + name, node.name) for name in served]
        edges += [(node.name, SERVICE + each.name) for each in node.clients]
        edges += [(ACTION + each.name, node.name) for each in node.action_servers]
        edges += [(node.name, ACTION + each.name) for each in node.action_clients]
    return edges


class _Labels:
    """The labels of the items."""

    def __init__(
        self, info: GraphInfo, view: GraphView, rates: Mapping[str, str], ids: Collection[str], faulty: Collection[str]
    ) -> None:
        self._rates = rates
        self._faulty = faulty
        self._short = view.short
        self._whole = view.whole
        self._tokens = Counter(_last(each) for each in ids)
        self._members = (
            Counter(box_of(each.name, view.folded) for each in info.nodes) if view.folded else Counter[str]()
        )

    def of(self, item: str) -> str:
        """The label of an item."""
        if item.startswith(SPACE):
            return f"▸ {self._name(item.removeprefix(SPACE))}  {counted(self._members[item], 'node')}"
        if not is_link(item):
            return self._name(item)
        kind, _, name = item.partition(":")
        text = self._name(name) if kind == "topic" else f"{kind[:3]} {self._name(name)}"
        text = f"✗ {text}" if item in self._faulty else text
        rate = self._rates.get(name, "") if kind == "topic" else ""
        return f"{text} {rate}" if rate else text

    def _name(self, name: str) -> str:
        text = harmless(name)
        if self._whole:
            return text
        if self._short and self._tokens[_last(name)] == 1 and "/" in text[1:]:
            text = "…/" + text.rpartition("/")[2]
        longest = SHORT if self._short else LONGEST
        return text if len(text) <= longest else text[: longest // 2] + "…" + text[-longest // 2 + 1 :]


def _last(item: str) -> str:
    return item.rpartition("/")[2]


def is_debug(topic: str) -> bool:
    """Whether a topic is for debugging: logs, parameter events, statistics, parts of actions, hidden names."""
    return topic in DEBUG_TOPICS or "/_" in topic


def is_link(item: str) -> bool:
    """Whether an item links nodes: a topic, a service, an action."""
    return item.startswith(LINKS)


def _wanted(topic: str, view: GraphView, sources: set[str], sinks: set[str], counts: Mapping[str, int]) -> bool:
    if not topic.startswith(TOPIC):
        return True
    if view.mode is Mode.ACTIVE and (topic not in sources or topic not in sinks):
        return False
    if not view.dead_sinks and topic not in sinks:
        return False
    return view.leaves or counts[topic] > 1


def _filtered(ids: set[str], edges: list[tuple[str, str]], query: Query) -> set[str]:
    """The matching items and those linked to them; an excluding word excludes both."""
    if not query.terms:
        return ids
    excluding, positive = query.part(exclude=True), query.part(exclude=False)
    allowed = {each for each in ids if matches(each, excluding)}
    found = {each for each in allowed if matches(each, positive)}
    if positive.terms:
        found |= {b for a, b in edges if a in found} | {a for a, b in edges if b in found}
    return found & allowed


def matches(item: str, query: Query) -> bool:
    """Whether a node or a topic passes a filter by its own name."""
    return query.matches(*_words(item))


def _words(item: str) -> tuple[str, str]:
    return (item.partition(":")[2], "") if is_link(item) else ("", item.removeprefix(SPACE))


def _nodes_only(nodes: list[str], edges: list[tuple[str, str]], label: _Labels) -> Digraph:
    published: dict[str, list[str]] = {}
    for a, b in edges:
        if is_link(b):
            published.setdefault(b, []).append(a)
    links = {(source, b) for a, b in edges if is_link(a) for source in published.get(a, ())}
    return Digraph(tuple(Item(each, label.of(each)) for each in sorted(nodes)), tuple(sorted(links)))


def summary(info: GraphInfo, item: str) -> str:
    """One line on a node or a topic."""
    if not item:
        return ""
    if item.startswith(SPACE):
        return harmless(f"{item.removeprefix(SPACE)}  enter or + unfolds it")
    if item.startswith((SERVICE, ACTION)):
        kind, _, name = item.partition(":")
        return harmless(f"{kind} {name}  {' '.join(server_types(info, item))}")
    if item.startswith(TOPIC):
        name = item.removeprefix(TOPIC)
        publishers, subscribers = ends_of(info, name)
        kinds = types_of(info, name)
        text = f"{name}  {', '.join(kinds) or 'type unknown'}  {counted(len(publishers), 'publisher')}"
        return harmless(f"{text}, {counted(len(subscribers), 'subscription')}{warning(publishers, subscribers)}")
    node = node_of(info, item)
    if node is None:
        return ""
    parts = [f"publishes {len(node.publishers)}", f"subscribes {len(node.subscriptions)}"]
    parts += [f"{counted(len(node.services), 'service')}", f"{counted(len(node.clients), 'client')}"]
    stopped = "".join(f" - frozen: process {pid} is stopped" for name, pid in info.frozen if name == item)
    stopped = stopped or (f" - {SILENT}" if item in info.silent else "")
    return harmless(f"{item}  {', '.join(parts)}{stopped}")


def server_types(info: GraphInfo, item: str) -> list[str]:
    """The types of a service or action, and its servers."""
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
    """What is unusual about a topic with these endpoints; empty if nothing is."""
    if not publishers:
        return " - nobody publishes it: is the name right?"
    return " - nobody listens" if not subscribers else ""


def ends_of(info: GraphInfo, topic: str) -> tuple[list[str], list[str]]:
    """The nodes that publish and that subscribe to a topic."""
    publishers = [node.name for node in info.nodes if any(each.name == topic for each in node.publishers)]
    subscribers = [node.name for node in info.nodes if any(each.name == topic for each in node.subscriptions)]
    return publishers, subscribers


def types_of(info: GraphInfo, topic: str) -> tuple[str, ...]:
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
    """The node with that name."""
    return next((each for each in info.nodes if each.name == name), None)
