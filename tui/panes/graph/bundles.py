"""Nodes and topics as a flow chart: everything from one box to another is drawn as one labelled line. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from bot_console.tui.panes.graph.namespaces import ACTION, SERVICE, SPACE, TOPIC, is_link, namespace_of
from bot_console.tui.text.counted import counted
from bot_console.tui.text.natural import natural_key
from bot_console.tui.text.sanitize import cut_name, sanitize
from bot_console.tui.widgets.diagram.flow_chart.model import Chart, ChartBox, ChartLink

LINE = "line:"
"""Prefix of the id of a line between two boxes."""
KINDS = {TOPIC: "", SERVICE: "srv ", ACTION: "act "}
MAX_LENGTH = 40
"""Maximum characters of a name."""
RATE_CELLS = 6
"""Cells reserved for a rate, so that the drawing does not move when the rate changes."""
LOOP = "↺"

Pair = tuple[str, str]
"""A sending box and a receiving box."""


@dataclass(frozen=True)
class Bundles:
    """A chart, and the topics, services and actions of each line, by its id."""

    chart: Chart = field(default_factory=Chart)
    links: Mapping[str, tuple[str, ...]] = field(default_factory=dict[str, tuple[str, ...]])
    looped: frozenset[str] = frozenset()
    """The topics, services and actions that lead from a node to itself."""
    faults: frozenset[Pair] = frozenset()
    """Edges of the drawing on which messages do not arrive."""

    @property
    def drawn(self) -> set[str]:
        """Every topic, service and action that is drawn on a line or in a box."""
        return {each for line in self.links.values() for each in line} | self.looped


def bundle_edges(
    nodes: Iterable[str],
    edges: Iterable[Pair],
    members: Mapping[str, int],
    faults: frozenset[tuple[str, str, str]],
    rates: Mapping[str, str],
    states: Mapping[str, str],
) -> Bundles:
    """Make a chart of nodes and folded namespaces from their edges to and from links (topics, services, actions).

    `members` is the number of nodes in each folded namespace, `faults` are triples of publisher, topic and subscriber
    between which no messages arrive, `rates` are texts by topic, and `states` the states of lifecycle nodes by name.
    """
    boxes = sorted(nodes)
    between = _links_between(edges)
    wrong: dict[Pair, set[str]] = {}
    for a, link, b in faults:
        wrong.setdefault((a, b), set()).add(link)
    names = _Names(boxes, {link for links in between.values() for link in links}, members, states)
    words = {pair: names.words(pair, links, wrong.get(pair, set())) for pair, links in between.items()}
    groups = _group_alike(boxes, words)
    group_of = {each: group for group in groups for each in group}
    links: dict[Pair, set[str]] = {}
    for (a, b), some in between.items():
        if a != b:
            links.setdefault((group_of[a][0], group_of[b][0]), set()).update(some)
    lines: list[ChartLink] = []
    broken: set[Pair] = set()
    for pair in sorted(links):
        ends = [group_of[each] for each in pair]
        alone = all(len(each) == 1 for each in ends)
        message = names.words(pair, links[pair], wrong.get(pair, set()), rates) if alone and rates else words[pair]
        line = ChartLink(f"{LINE}{pair[0]}>{pair[1]}", *pair, message)
        lines.append(line)
        if pair in wrong:
            broken |= {(each, line.id) for each in ends[0]} | {(line.id, each) for each in ends[1]}
    boxes_drawn = tuple(
        ChartBox(group[0], tuple((each, names.box(each)) for each in group), _loop(group, words)) for group in groups
    )
    return Bundles(
        Chart(boxes_drawn, tuple(lines)),
        {line.id: tuple(sorted(links[line.source, line.target])) for line in lines},
        frozenset(link for (a, b), some in between.items() if a == b for link in some),
        frozenset(broken),
    )


def _links_between(edges: Iterable[Pair]) -> dict[Pair, set[str]]:
    """The links from one box to another, without those that stay within a folded namespace."""
    sources: dict[str, set[str]] = {}
    targets: dict[str, set[str]] = {}
    for a, b in edges:
        if is_link(b):
            sources.setdefault(b, set()).add(a)
        else:
            targets.setdefault(a, set()).add(b)
    found: dict[Pair, set[str]] = {}
    for link, givers in sources.items():
        for a in givers:
            for b in targets.get(link, ()):
                if a != b or not a.startswith(SPACE):
                    found.setdefault((a, b), set()).add(link)
    return found


def _loop(group: tuple[str, ...], words: Mapping[Pair, tuple[str, ...]]) -> str:
    found = words.get((group[0], group[0]), ())
    return " ".join((LOOP, *found)) if found else ""


def _group_alike(boxes: list[str], words: Mapping[Pair, tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Group boxes that have the same labels to and from the same boxes; any other box is a group by itself."""
    ends: dict[str, set[tuple[str, str, tuple[str, ...]]]] = {}
    for (a, b), found in words.items():
        ends.setdefault(a, set()).add(("to", "" if a == b else b, found))
        ends.setdefault(b, set()).add(("from", "" if a == b else a, found))
    groups: dict[object, list[str]] = {}
    for each in boxes:
        alike = (each.startswith(SPACE), frozenset(ends[each])) if each in ends else each
        groups.setdefault(alike, []).append(each)
    return [tuple(sorted(group, key=natural_key)) for group in groups.values()]


class _Names:
    """Shortens names to their last part, unless two of them would become the same."""

    def __init__(
        self, boxes: Iterable[str], links: Iterable[str], members: Mapping[str, int], states: Mapping[str, str]
    ) -> None:
        self._states = states
        self._boxes = Counter(_last(each) for each in boxes)
        self._links = Counter(_last(each) for each in links)
        self._members = members

    def box(self, box: str) -> str:
        name = box.removeprefix(SPACE)
        space = box.startswith(SPACE)
        # If namespaces are folded, the full name shows which namespace a node is in.
        unique = self._boxes[_last(name)] == 1 and (space or not self._members)
        text = cut_name(sanitize(_last(name) if unique else name), MAX_LENGTH)
        if space:
            return f"▸ {text}  {counted(self._members.get(box, 0), 'node')}"
        return text + state_mark(self._states.get(box, ""))

    def words(
        self, pair: Pair, links: Iterable[str], faulty: Collection[str], rates: Mapping[str, str] = MappingProxyType({})
    ) -> tuple[str, ...]:
        """The labels of a pair's links, faulty ones first; several links in one namespace share a label."""
        spaces: dict[tuple[str, str], list[str]] = {}
        for link in sorted(links):
            kind, _, name = link.partition(":")
            inner = _relative_name(name, pair)
            space = (inner or name).rpartition("/")[0].strip("/")
            spaces.setdefault((kind, space), []).append(link)
        found: list[tuple[bool, str]] = []
        for (_, space), some in spaces.items():
            if space and len(some) > 1:
                kind = KINDS[some[0].partition(":")[0] + ":"]
                found.append(
                    (any(each in faulty for each in some), f"{kind}{sanitize(space.rpartition('/')[2])} ×{len(some)}")
                )
            else:
                found += [(each in faulty, self._word(each, pair, rates)) for each in some]
        return tuple(
            f"✗ {word}" if wrong else word for wrong, word in sorted(found, key=lambda each: (not each[0], each[1]))
        )

    def _word(self, link: str, pair: Pair, rates: Mapping[str, str]) -> str:
        kind, _, name = link.partition(":")
        inner = _relative_name(name, pair)
        short = _last(name)
        if self._links[short] > 1:
            short = inner or name
        text = KINDS[f"{kind}:"] + cut_name(sanitize(short), MAX_LENGTH)
        rate = rates.get(name) if kind == "topic" else None
        return f"{text} {rate:<{RATE_CELLS}}" if rate else text


def state_mark(state: str) -> str:
    """The state of a lifecycle node as it is appended to the node's name; empty if there is none."""
    return f" ({sanitize(state)})" if state else ""


def _relative_name(name: str, pair: Pair) -> str:
    """A name without the namespace of the box that sends or receives it; empty if it is in neither."""
    for box in pair:
        own = box.removeprefix(SPACE)
        for space in (own, "" if box.startswith(SPACE) else namespace_of(own)):
            if space and name.startswith(f"{space}/"):
                return name.removeprefix(f"{space}/")
    return ""


def _last(item: str) -> str:
    return item.rpartition("/")[2]
