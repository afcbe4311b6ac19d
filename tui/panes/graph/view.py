"""Which part of the ROS graph is drawn: modes, filters and hidden topics, as in rqt_graph. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from types import MappingProxyType

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.graph.connections import connections, unconnected
from bot_console.tui.console.graph.hidden_names import TOOL_NAMES, is_hidden
from bot_console.tui.console.model import GraphInfo, NodeInfo
from bot_console.tui.panes.graph.bundles import Bundles, bundle_edges, state_mark
from bot_console.tui.panes.graph.filtering import items_passing
from bot_console.tui.panes.graph.focus_history import Focus, items_around
from bot_console.tui.panes.graph.namespaces import ACTION, SERVICE, SPACE, TOPIC, box_of, folded_edges, is_link
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.diagram.flow_chart.model import Chart
from bot_console.tui.widgets.diagram.graph import Digraph, Item
from bot_console.tui.widgets.diagram.listing import Listing

MAX_LENGTH, SHORT = 40, 16


class Mode(Enum):
    """The drawing modes in the order in which `m` cycles through them, with rqt_graph's names where it has them."""

    FLOW = "Flow"
    NODES = "Nodes only"
    ACTIVE = "Nodes/Topics (active)"
    ALL = "Nodes/Topics (all)"
    LIST = "List"


@dataclass(frozen=True)
class GraphView:
    """The user's choices for drawing the graph."""

    mode: Mode = Mode.FLOW
    query: Query = field(default_factory=Query)
    hides: tuple[str, ...] = TOOL_NAMES
    """Patterns of the names of topics and nodes that are not drawn, such as `/camera/*`."""
    debug: bool = False
    """Whether names that `hides` matches or that ROS hides are drawn, too."""
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
    """Whether names are never shortened, as in an exported file."""

    def hides_name(self, name: str) -> bool:
        """Whether a node or a topic with this name is not drawn."""
        return not self.debug and is_hidden(name, self.hides)


@dataclass(frozen=True)
class VisibleGraph:
    """The graph to draw, the topics without a publisher or a subscriber, and how many topics are left out."""

    graph: Digraph
    dead_ends: frozenset[str] = frozenset()
    faults: frozenset[tuple[str, str]] = frozenset()
    """Edges on which no messages arrive, because the QoS of their ends does not match."""

    silent: frozenset[str] = frozenset()
    """Nodes that do not answer, or whose process is frozen."""

    bundles: Bundles = field(default_factory=Bundles)
    """The graph as a flow chart; filled in mode Flow only."""

    listing: Listing = field(default_factory=Listing)
    """The graph as a list; filled in mode List only."""

    unsent: tuple[str, ...] = ()
    """Items that nobody publishes or serves; filled in mode Flow only, which does not draw them."""

    unheard: tuple[str, ...] = ()
    """Items that nobody subscribes to or calls; filled in mode Flow only."""

    links_drawn: int = 0
    """Number of topics in the drawing, including services and actions if these are shown."""

    links_there: int = 0
    """Number of links that are not hidden, whether they pass the filter or not."""

    links_hidden: int = 0
    """Number of links that the view hides."""

    @property
    def topics_drawn(self) -> list[str]:
        """The names of the topics in the drawing."""
        items = self.bundles.drawn if self.bundles.chart.boxes else {each.id for each in self.graph.items}
        return sorted(each.removeprefix(TOPIC) for each in items if each.startswith(TOPIC))

    @property
    def content(self) -> Digraph | Chart | Listing:
        """The chart, list or graph to lay out."""
        return self.bundles.chart if self.bundles.chart.boxes else self.listing if self.listing.entries else self.graph


def visible_graph(info: GraphInfo, view: GraphView, rates: Mapping[str, str] = MappingProxyType({})) -> VisibleGraph:
    """Select nodes and topics, and convert them to items and edges; `rates` are appended to topic names."""
    nodes = [each for each in info.nodes if not view.hides_name(each.name)]
    edges = _edges(nodes, view)
    topics = {TOPIC + each.name for each in info.topics} | {each for edge in edges for each in edge if is_link(each)}
    kept = {each for each in topics if not view.hides_name(each.partition(":")[2])}
    there, hidden = len(kept), len(topics) - len(kept)
    sources, sinks = {b for _, b in edges}, {a for a, _ in edges}
    dead_ends = frozenset(each for each in kept if each not in sources or each not in sinks)
    counts = Counter(each for edge in edges for each in edge)
    kept = {each for each in kept if _wanted(each, view, sources, sinks, counts)}
    ids = items_passing(
        {each.name for each in nodes} | kept, edges, view.query, both_ends=view.mode in (Mode.FLOW, Mode.LIST)
    )
    edges = [(a, b) for a, b in edges if a in ids and b in ids]
    faults = {
        (TOPIC + topic, subscriber)
        for topic, pairs in info.incompatible.items()
        if TOPIC + topic in ids
        for _, subscriber, _ in pairs
    }
    if view.folded and view.mode is not Mode.LIST:
        drawn, inside = folded_edges(edges, view.folded, {each for each in ids if is_link(each)})
        edges = sorted(drawn)
        ids = {each if is_link(each) else box_of(each, view.folded) for each in ids - inside}
        faults = {(topic, box_of(node, view.folded)) for topic, node in faults if topic in ids}
    if view.focus.item:
        near = items_around(view.focus, edges)
        ids &= near
        edges = [(a, b) for a, b in edges if a in ids and b in ids]
    silent = frozenset((*info.silent, *(name for name, _ in info.frozen)))
    if view.mode is Mode.NODES:
        graph = _nodes_only([each for each in ids if not is_link(each)], edges, _Labels(info, view, {}, ids, set()))
        return VisibleGraph(graph, silent=silent)
    label = _Labels(info, view, rates, ids, {topic for topic, _ in faults})
    items = tuple(Item(each, label.of(each), not is_link(each), int(is_link(each))) for each in sorted(ids))
    found = VisibleGraph(Digraph(items, tuple(sorted(edges))), dead_ends & ids, frozenset(faults), silent)
    found = replace(found, links_drawn=sum(map(is_link, ids)), links_there=there, links_hidden=hidden)
    if view.mode is Mode.LIST:
        return replace(found, listing=_listing(info, {each.name for each in nodes}, ids, view))
    if view.mode is not Mode.FLOW:
        return found
    triples = frozenset(
        (box_of(a, view.folded), TOPIC + topic, box_of(b, view.folded))
        for topic, pairs in info.incompatible.items()
        for a, b, _ in pairs
    )
    bundles = bundle_edges(
        (each for each in ids if not is_link(each)), edges, label.members, triples, rates, info.lifecycle
    )
    dead = sorted(dead_ends & ids)
    return replace(
        found,
        bundles=bundles,
        links_drawn=len(bundles.drawn),
        unsent=tuple(each for each in dead if each not in sources),
        unheard=tuple(each for each in dead if each in sources),
    )


def _listing(info: GraphInfo, names: set[str], ids: set[str], view: GraphView) -> Listing:
    """The connections, followed by the nodes that have none."""
    nodes = tuple(each for each in info.nodes if each.name in names)
    kinds = ("topic", "service", "action") if view.services else ("topic",)
    every = connections(replace(info, nodes=nodes), kinds)
    lines = {f"{kind}:{name}": text for kind, name, text in every if f"{kind}:{name}" in ids}
    alone = unconnected((each for each in nodes if each.name in ids), {each.partition(":")[::2] for each in lines})
    return Listing(
        (*((each, sanitize(text)) for each, text in lines.items()), *((each, sanitize(each)) for each in alone))
    )


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
        self._states = info.lifecycle
        self._rates = rates
        self._faulty = faulty
        self._short = view.short
        self._whole = view.whole
        self._tokens = Counter(_last(each) for each in ids)
        self.members = Counter(box_of(each.name, view.folded) for each in info.nodes) if view.folded else Counter[str]()

    def of(self, item: str) -> str:
        """The label of an item."""
        if item.startswith(SPACE):
            return f"▸ {self._name(item.removeprefix(SPACE))}  {counted(self.members[item], 'node')}"
        if not is_link(item):
            return self._name(item) + state_mark(self._states.get(item, ""))
        kind, _, name = item.partition(":")
        text = self._name(name) if kind == "topic" else f"{kind[:3]} {self._name(name)}"
        text = f"✗ {text}" if item in self._faulty else text
        rate = self._rates.get(name, "") if kind == "topic" else ""
        return f"{text} {rate}" if rate else text

    def _name(self, name: str) -> str:
        text = sanitize(name)
        if self._whole:
            return text
        if self._short and self._tokens[_last(name)] == 1 and "/" in text[1:]:
            text = "…/" + text.rpartition("/")[2]
        longest = SHORT if self._short else MAX_LENGTH
        return text if len(text) <= longest else text[: longest // 2] + "…" + text[-longest // 2 + 1 :]


def _last(item: str) -> str:
    return item.rpartition("/")[2]


def _wanted(topic: str, view: GraphView, sources: set[str], sinks: set[str], counts: Mapping[str, int]) -> bool:
    if not topic.startswith(TOPIC):
        return True
    if view.mode is Mode.ACTIVE and (topic not in sources or topic not in sinks):
        return False
    if not view.dead_sinks and topic not in sinks:
        return False
    return view.leaves or counts[topic] > 1


def _nodes_only(nodes: list[str], edges: list[tuple[str, str]], label: _Labels) -> Digraph:
    published: dict[str, list[str]] = {}
    for a, b in edges:
        if is_link(b):
            published.setdefault(b, []).append(a)
    links = {(source, b) for a, b in edges if is_link(a) for source in published.get(a, ())}
    return Digraph(tuple(Item(each, label.of(each)) for each in sorted(nodes)), tuple(sorted(links)))
