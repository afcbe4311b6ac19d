"""Texts below the drawing and in its border: what is drawn, dead ends, and the selected item. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence

from bot_console.tui.console.graph.anomalies import findings
from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.about import node_of, nodes_on_topic, summary
from bot_console.tui.panes.graph.bundles import LINE, LOOP
from bot_console.tui.panes.graph.namespaces import SPACE, TOPIC
from bot_console.tui.panes.graph.rates import IDLE
from bot_console.tui.panes.graph.view import GraphView, VisibleGraph
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from rich.cells import cell_len

GAP = "  "
EMPTY = Placeholder(
    "The graph shows nodes and their topics; there are no nodes yet.", (("8", "Start nodes"), ("?", "Help"))
)
UNSENT, UNHEARD = "No publisher ", "No subscriber"
INDENT_CELLS = 7
"""Cells of `sends` or `reads` with the blanks behind it."""


def caption(info: GraphInfo, found: VisibleGraph, view: GraphView, words: str) -> str:
    """A summary of the drawing, for the bottom border of the pane."""
    parts = [view.mode.value]
    if info.nodes:
        parts.append(counted(sum(1 for each in info.nodes if not view.hides_name(each.name)), "node"))
    if found.links_there:
        what = "topics and services" if view.services else "topic" if found.links_there == 1 else "topics"
        parts.append(f"{found.links_drawn} of {found.links_there} {what}")
    parts += [f"D {found.links_hidden} hidden"] if found.links_hidden else []
    parts += [f"/{words}"] if words else []
    focus = view.focus
    parts += [f"around {focus.item.removeprefix(TOPIC)}, {counted(focus.hops, 'hop')}"] if focus.item else []
    odd = len(findings(info)) if info.nodes else 0
    parts += [f"w {counted(odd, 'finding')}"] if odd else []
    return " · ".join(parts)


def item_summary(info: GraphInfo, found: VisibleGraph, view: GraphView, item: str) -> str:
    """Describe an item of the drawing in one line; a connecting line is described by everything on it."""
    links = found.bundles.links.get(item)
    if links is None:
        return summary(info, item, view.hides_name)
    source, _, target = item.removeprefix(LINE).partition(">")
    names = " ".join(each.partition(":")[2] for each in links)
    return sanitize(f"{source.removeprefix(SPACE)} → {target.removeprefix(SPACE)}  {names}")


def empty_placeholder(info: GraphInfo) -> Placeholder:
    """The text that is shown while nothing is drawn."""
    return FILTERED_OUT if any(not each.hidden for each in info.nodes) else EMPTY


def item_notes(
    snapshot: ConsoleSnapshot,
    found: VisibleGraph,
    view: GraphView,
    item: str,
    rates: Mapping[str, str],
    width: int,
    maximum: int,
) -> list[str]:
    """The endpoints of an item and their nodes, in at most `maximum` lines of `width` cells."""
    links = found.bundles.links.get(item)
    if item.startswith(SPACE):
        return _space_notes(snapshot, view, item.removeprefix(SPACE), rates, width, maximum)
    if links is None:
        return _node_notes(snapshot, view, item, rates, width, maximum)
    return _link_notes(snapshot.graph, links, rates, width, maximum)


def dead_ends(found: VisibleGraph, width: int) -> list[str]:
    """One line for items that nobody publishes or serves, one for those that nobody subscribes to or calls.

    As many items are named as fit; the others are counted.
    """
    return [
        title_with_names(title, [each.partition(":")[2] for each in items], width)
        for title, items in ((UNSENT, found.unsent), (UNHEARD, found.unheard))
        if items
    ]


def legend(found: VisibleGraph, width: int) -> str:
    """The meaning of the marks that occur in a flow chart, as far as it fits in `width` cells."""
    chart = found.bundles.chart
    loops = [box.loop for box in chart.boxes if box.loop]
    words = [word for link in chart.links for word in link.words]
    marks = {
        "✗ QoS does not match": any(word.startswith("✗") for word in words),
        f"{LOOP} sent to itself": bool(loops),
        "×2 two topics of a namespace": any(" ×" in word for word in (*words, *loops, *dead_ends(found, width))),
        f"{IDLE}: no messages now": any(word.rstrip().endswith(f" {IDLE}") for word in words),
    }
    text = ""
    for mark in (mark for mark, there in marks.items() if there):
        longer = f"{text}{GAP * 2 if text else ''}{mark}"
        text = longer if cell_len(longer) <= width else text
    return text


def title_with_names(title: str, names: Sequence[str], width: int) -> str:
    """The title and as many names as fit in `width` cells; the others are counted."""
    words = _fold_names(names)
    text = f"{title}{GAP}{GAP.join(word for word, _ in words)}"
    shown = len(words)
    while cell_len(text) > width and shown:
        shown -= 1
        left = sum(count for _, count in words[shown:])
        more = f"{left} more" if shown else counted(left, "topic")
        text = GAP.join([title, *(word for word, _ in words[:shown]), more])
    return cut(text, width)


def _fold_names(names: Iterable[str]) -> list[tuple[str, int]]:
    """The names without the leading slash, several in one namespace as one word; each with the number it represents."""
    known = sorted(names)
    spaces = Counter(each.rpartition("/")[0] for each in known)
    words: dict[str, int] = {}
    for each in known:
        space = each.rpartition("/")[0]
        many = spaces[space] if space else 1
        words[sanitize(f"{space[1:]} ×{many}" if many > 1 else each.lstrip("/"))] = many
    return sorted(words.items(), key=lambda each: (each[1] > 1, each[0]))


def _node_notes(
    snapshot: ConsoleSnapshot, view: GraphView, name: str, rates: Mapping[str, str], width: int, maximum: int
) -> list[str]:
    """The topics that a node publishes and subscribes to, with the nodes at their other ends, in at most `maximum`
    lines; empty if there is no such node or no room.
    """
    info = snapshot.graph
    node = node_of(info, name)
    if node is None or maximum < 2:
        return []
    lines = [
        *_ends(info, view, "sends", node.publishers, rates, width, publishing=True),
        *_ends(info, view, "reads", node.subscriptions, rates, width, publishing=False),
    ]
    return _fit_lines(_head(snapshot, name, [node]), lines, width, maximum, "press enter")


def _space_notes(
    snapshot: ConsoleSnapshot, view: GraphView, space: str, rates: Mapping[str, str], width: int, maximum: int
) -> list[str]:
    """The topics that lead out of and into a namespace, then the topics of each of its nodes, in at most `maximum`
    lines; empty if it has no visible node or there is no room.
    """
    info = snapshot.graph
    nodes = [each for each in info.nodes if each.name.startswith(f"{space}/") and not each.hidden]
    if not nodes or maximum < 2:
        return []
    names = {each.name for each in nodes}
    published = {end.name: end for each in nodes for end in each.publishers}
    subscribed = {end.name: end for each in nodes for end in each.subscriptions}
    lines = [
        *_ends(info, view, "sends", published.values(), rates, width, publishing=True, inside=names),
        *_ends(info, view, "reads", subscribed.values(), rates, width, publishing=False, inside=names),
    ]
    longest = max(cell_len(each.name) for each in nodes) - len(space) - 1
    lines += [_member_line(each, view, space, longest, width) for each in nodes]
    return _fit_lines(_head(snapshot, space, nodes), lines, width, maximum, "enter unfolds it")


def _member_line(node: NodeInfo, view: GraphView, space: str, longest: int, width: int) -> str:
    """A node of a namespace with the names of its topics."""
    parts = [
        f"{verb} {' '.join(names)}"
        for verb, ends in (("sends", node.publishers), ("reads", node.subscriptions))
        if (names := [_below(each.name, space) for each in ends if not view.hides_name(each.name)])
    ]
    return cut(f"{' ' * INDENT_CELLS}{node.name.removeprefix(f'{space}/'):<{longest}}{GAP}{GAP.join(parts)}", width)


def _below(topic: str, space: str) -> str:
    """The name of a topic, relative to the namespace if it is inside."""
    return topic.removeprefix(f"{space}/")


def _head(snapshot: ConsoleSnapshot, name: str, nodes: Sequence[NodeInfo]) -> str:
    """The name of a node or a namespace, with the numbers of its nodes, processes, parameters and services."""
    names = {each.name for each in nodes}
    processes = [each.label for each in snapshot.launch.processes if names & set(each.nodes)]
    trees = [snapshot.parameters[each] for each in names if each in snapshot.parameters]
    parts = [counted(len(nodes), "node")] if len(nodes) > 1 else []
    parts += [f"process {each}" for each in processes] if len(nodes) == 1 else [counted(len(processes), "process")]
    parts += [counted(sum(len(each.parameters) for each in trees), "parameter")] if trees else []
    parts += [counted(sum(len(each.services) for each in nodes), "service")]
    return f"{name}{GAP}{' · '.join(parts)}"


def _fit_lines(head: str, lines: Sequence[str], width: int, maximum: int, how: str) -> list[str]:
    """The heading and the lines, at most `maximum` in all; `how` tells the user how to see the others."""
    if len(lines) > maximum - 1:
        left = len(lines) - maximum + 2
        lines = [*lines[: maximum - 2], f"{' ' * INDENT_CELLS}{left} more lines: {how}"] if maximum > 2 else []
    return [cut(sanitize(each), width) for each in (head, *lines)]


def _ends(
    info: GraphInfo,
    view: GraphView,
    verb: str,
    ends: Iterable[Endpoint],
    rates: Mapping[str, str],
    width: int,
    *,
    publishing: bool,
    inside: Collection[str] = (),
) -> list[str]:
    """The topics of one direction, each with the nodes at its other end, several per line where they fit.

    Topics whose other ends are all `inside` are left out; topics that the view hides are counted.
    """
    words: list[str] = []
    lonely: list[str] = []
    hidden = 0
    for each in ends:
        if view.hides_name(each.name):
            hidden += 1
            continue
        others = [one for one in nodes_on_topic(info, each.name)[1 if publishing else 0] if "/_" not in one]
        if not others:
            lonely.append(each.name)
            continue
        others = [one for one in others if one not in inside]
        if not others:
            continue
        rate = f" {rates[each.name]}" if rates.get(each.name) else ""
        arrow = "→" if publishing else "←"
        words.append(f"{each.name}{rate} {arrow} {' '.join(others)}")
    last = [f"{hidden} hidden"] if hidden else []
    if lonely:
        room = width - INDENT_CELLS - 1 - sum(len(GAP) * 2 + len(each) for each in last)
        words.append(title_with_names("no subscriber:" if publishing else "no publisher:", lonely, room))
    words += last
    lines: list[str] = []
    for word in words:
        if lines and cell_len(lines[-1]) + len(GAP) * 2 + cell_len(word) <= width:
            lines[-1] += GAP * 2 + word
        else:
            lines.append(f"{verb if not lines else '':<{INDENT_CELLS}}{word}")
    return lines


def _link_notes(info: GraphInfo, links: Iterable[str], rates: Mapping[str, str], width: int, maximum: int) -> list[str]:
    """The topics, services and actions on a connecting line, with their nodes, in at most `maximum` lines."""
    lines: list[str] = []
    for link in links:
        name = link.partition(":")[2]
        if not link.startswith(TOPIC):
            lines.append(link.replace(":", " ", 1))
            continue
        publishers, subscribers = nodes_on_topic(info, name)
        rate = f" {rates[name]}" if rates.get(name) else ""
        lines.append(f"{name}{rate}{GAP}{' '.join(publishers)} → {' '.join(subscribers)}")
    if len(lines) > maximum:
        lines = [*lines[: maximum - 1], f"{len(lines) - maximum + 1} more"] if maximum > 0 else []
    return [cut(sanitize(each), width) for each in lines]
