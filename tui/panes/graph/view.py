"""Which part of the ROS graph is drawn: modes, filters and hidden topics, as in rqt_graph. Pure."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.query import Query
from bot_console.tui.format import counted, harmless
from bot_console.tui.widgets.diagram.graph import Digraph, Item

DEBUG_TOPICS = ("/rosout", "/parameter_events", "/statistics", "/rosout_agg", "/diagnostics_agg")
"""Topics of every node, and of tools: with them each drawing is a knot."""

TOPIC = "topic:"
LONGEST = 40


class Mode(Enum):
    """What stands for what, in rqt_graph's words."""

    ACTIVE = "nodes and topics in use"
    ALL = "nodes and all topics"
    NODES = "nodes only"


@dataclass(frozen=True)
class GraphView:
    """How a person wants to see the graph."""

    mode: Mode = Mode.ALL
    query: Query = field(default_factory=Query)
    debug: bool = False
    dead_sinks: bool = True
    leaves: bool = True


@dataclass(frozen=True)
class Shown:
    """The graph to draw, topics that lack a publisher or a subscriber, and how much is left out."""

    graph: Digraph
    dead_ends: frozenset[str] = frozenset()
    hidden: int = 0


def shown(info: GraphInfo, view: GraphView) -> Shown:
    """Choose nodes and topics, and turn them into items and edges."""
    nodes = [each for each in info.nodes if view.debug or not each.hidden]
    edges = [(node.name, TOPIC + each.name) for node in nodes for each in node.publishers]
    edges += [(TOPIC + each.name, node.name) for node in nodes for each in node.subscriptions]
    topics = {each.name for each in info.topics} | {a.removeprefix(TOPIC) for e in edges for a in e if _is_topic(a)}
    everything = len(nodes) + len(topics)
    kept = {TOPIC + each for each in topics if view.debug or not is_debug(each)}
    sources = {b for _, b in edges}
    sinks = {a for a, _ in edges}
    dead_ends = frozenset(each for each in kept if each not in sources or each not in sinks)
    kept = {each for each in kept if _wanted(each, view, sources, sinks, edges)}
    ids = _filtered({each.name for each in nodes} | kept, edges, view.query)
    edges = [(a, b) for a, b in edges if a in ids and b in ids]
    hidden = everything - len(ids)
    if view.mode is Mode.NODES:
        return Shown(_nodes_only([each for each in ids if not _is_topic(each)], edges), hidden=hidden)
    items = tuple(Item(each, _label(each), not _is_topic(each), int(_is_topic(each))) for each in sorted(ids))
    return Shown(Digraph(items, tuple(sorted(edges))), dead_ends & ids, hidden)


def is_debug(topic: str) -> bool:
    """Whether a topic is a tool's: logs, parameter events, statistics, actions' insides, hidden names."""
    return topic in DEBUG_TOPICS or "/_" in topic


def _is_topic(item: str) -> bool:
    return item.startswith(TOPIC)


def _label(item: str) -> str:
    text = harmless(item.removeprefix(TOPIC))
    return text if len(text) <= LONGEST else text[: LONGEST // 2] + "…" + text[-LONGEST // 2 + 1 :]


def _wanted(topic: str, view: GraphView, sources: set[str], sinks: set[str], edges: list[tuple[str, str]]) -> bool:
    if view.mode is Mode.ACTIVE and (topic not in sources or topic not in sinks):
        return False
    if not view.dead_sinks and topic not in sinks:
        return False
    return view.leaves or sum(topic in each for each in edges) > 1


def _filtered(ids: set[str], edges: list[tuple[str, str]], query: Query) -> set[str]:
    """What matches, and what is linked to it; an excluding word excludes in either case."""
    if not query.terms:
        return ids
    excluding, positive = query.part(exclude=True), query.part(exclude=False)
    allowed = {each for each in ids if excluding.matches(*_words(each))}
    found = {each for each in allowed if positive.matches(*_words(each))}
    if positive.terms:
        found |= {b for a, b in edges if a in found} | {a for a, b in edges if b in found}
    return found & allowed


def _words(item: str) -> tuple[str, str]:
    return ("", item) if not _is_topic(item) else (item.removeprefix(TOPIC), "")


def _nodes_only(nodes: list[str], edges: list[tuple[str, str]]) -> Digraph:
    published: dict[str, list[str]] = {}
    for a, b in edges:
        if _is_topic(b):
            published.setdefault(b, []).append(a)
    links = {(source, b) for a, b in edges if _is_topic(a) for source in published.get(a, ())}
    return Digraph(tuple(Item(each, _label(each)) for each in sorted(nodes)), tuple(sorted(links)))


def summary(info: GraphInfo, item: str) -> str:
    """One line on a node or a topic."""
    if not item:
        return ""
    if _is_topic(item):
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
    return harmless(f"{item}  {', '.join(parts)}")


def warning(publishers: list[str], subscribers: list[str]) -> str:
    """What is odd about a topic with these ends; empty when nothing is."""
    if not publishers:
        return " - nobody publishes it: is the name right?"
    return " - nobody listens" if not subscribers else ""


def ends_of(info: GraphInfo, topic: str) -> tuple[list[str], list[str]]:
    """The nodes that publish and that subscribe to a topic."""
    publishers = [node.name for node in info.nodes if any(each.name == topic for each in node.publishers)]
    subscribers = [node.name for node in info.nodes if any(each.name == topic for each in node.subscriptions)]
    return publishers, subscribers


def types_of(info: GraphInfo, topic: str) -> tuple[str, ...]:
    """The types of a topic; more than one is a mistake in the system."""
    found: dict[str, None] = {}
    every: list[Endpoint] = [*info.topics]
    for node in info.nodes:
        every += [*node.publishers, *node.subscriptions]
    for each in every:
        if each.name == topic:
            found.update(dict.fromkeys(each.types))
    return tuple(found)


def node_of(info: GraphInfo, name: str) -> NodeInfo | None:
    """The node of that name."""
    return next((each for each in info.nodes if each.name == name), None)
