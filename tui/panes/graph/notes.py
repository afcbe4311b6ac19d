"""What stands below the drawing and in the frame: what is drawn, dead ends, and the selected item. Pure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from bot_console.tui.console.graph.connections import TOOL_NAMES, is_hidden
from bot_console.tui.console.graph.findings import findings
from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo
from bot_console.tui.format import counted, cut, sanitize
from bot_console.tui.panes.graph.about import ends_of, node_of, summary
from bot_console.tui.panes.graph.bundles import LINE
from bot_console.tui.panes.graph.namespaces import SPACE, TOPIC
from bot_console.tui.panes.graph.view import GraphView, Mode, Shown
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from rich.cells import cell_len

GAP = "  "
EMPTY = Placeholder(
    "Nodes, and the topics between them: there are no nodes yet.", (("8", "Start nodes"), ("?", "Help"))
)
UNSENT, UNHEARD = "No publisher ", "No subscriber"
INDENT = 7
"""Cells of `sends` and `reads`, with the blanks around them."""


def caption(info: GraphInfo, found: Shown, view: GraphView, words: str) -> str:
    """What is drawn, for the lower edge of the frame."""
    parts = [view.mode.value]
    if view.mode is Mode.FLOW and found.every:
        nodes = counted(sum(1 for each in info.nodes if not each.hidden), "node")
        parts.append(f"{nodes} · {len(found.bundles.drawn)} of {counted(found.links_there, 'topic')}")
    parts += [f"/{words}"] if words else []
    focus = view.focus
    parts += [f"around {focus.item.removeprefix(TOPIC)}, {counted(focus.hops, 'hop')}"] if focus.item else []
    odd = len(findings(info)) if info.nodes else 0
    parts += [f"w {counted(odd, 'finding')}"] if odd else []
    if view.mode is not Mode.FLOW and found.hidden:
        parts.append(f"{found.every - found.hidden} of {found.every}")
    return " · ".join(parts)


def summary_of(info: GraphInfo, found: Shown, item: str) -> str:
    """One line on an item of the drawing; a line stands for all that is on it."""
    links = found.bundles.links.get(item)
    if links is None:
        return summary(info, item)
    source, _, target = item.removeprefix(LINE).partition(">")
    names = " ".join(each.partition(":")[2] for each in links)
    return sanitize(f"{source.removeprefix(SPACE)} → {target.removeprefix(SPACE)}  {names}")


def nothing_drawn(info: GraphInfo) -> Placeholder:
    """What is said while nothing is drawn."""
    return FILTERED_OUT if any(not each.hidden for each in info.nodes) else EMPTY


def item_notes(
    snapshot: ConsoleSnapshot, found: Shown, item: str, rates: Mapping[str, str], width: int, maximum: int
) -> list[str]:
    """Everything about the ends of an item, in at most so many lines."""
    links = found.bundles.links.get(item)
    if links is None:
        return _node_notes(snapshot, item, rates, width, maximum)
    return _link_notes(snapshot.graph, links, rates, width, maximum)


def dead_ends(found: Shown, width: int) -> list[str]:
    """One line for what nobody publishes or serves, one for what nobody subscribes to or calls; named where it fits."""
    return [
        named(title, [each.partition(":")[2] for each in items], width)
        for title, items in ((UNSENT, found.unsent), (UNHEARD, found.unheard))
        if items
    ]


def named(title: str, names: Sequence[str], width: int) -> str:
    """The title and as many names as fit; the others as a number."""
    words = _folded(names)
    text = f"{title}{GAP}{GAP.join(word for word, _ in words)}"
    shown = len(words)
    while cell_len(text) > width and shown:
        shown -= 1
        left = sum(count for _, count in words[shown:])
        more = f"{left} more" if shown else counted(left, "topic")
        text = GAP.join([title, *(word for word, _ in words[:shown]), more])
    return cut(text, width)


def _folded(names: Iterable[str]) -> list[tuple[str, int]]:
    """The names without the leading slash; several of one namespace as one word. Each with how many it stands for."""
    known = sorted(names)
    spaces = Counter(each.rpartition("/")[0] for each in known)
    words: dict[str, int] = {}
    for each in known:
        space = each.rpartition("/")[0]
        many = spaces[space] if space else 1
        words[sanitize(f"{space[1:]} ×{many}" if many > 1 else each.lstrip("/"))] = many
    return sorted(words.items(), key=lambda each: (each[1] > 1, each[0]))


def _node_notes(snapshot: ConsoleSnapshot, name: str, rates: Mapping[str, str], width: int, maximum: int) -> list[str]:
    """What a node sends and reads, and to and from whom, in at most so many lines; empty without room or node."""
    info = snapshot.graph
    node = node_of(info, name)
    if node is None or maximum < 2:
        return []
    tree = snapshot.parameters.get(name)
    processes = [each.label for each in snapshot.launch.processes if name in each.nodes]
    parts = [f"process {each}" for each in processes]
    parts += [counted(len(tree.parameters), "parameter")] if tree else []
    parts += [counted(len(node.services), "service")]
    head = f"{name}{GAP}{' · '.join(parts)}"
    lines = [
        *_ends(info, "sends", node.publishers, rates, width, publishing=True),
        *_ends(info, "reads", node.subscriptions, rates, width, publishing=False),
    ]
    if len(lines) > maximum - 1:
        lines = (
            [*lines[: maximum - 2], f"{' ' * INDENT}{len(lines) - maximum + 2} more lines: press enter"]
            if maximum > 2
            else []
        )
    return [cut(sanitize(each), width) for each in (head, *lines)]


def _ends(
    info: GraphInfo, verb: str, ends: Iterable[Endpoint], rates: Mapping[str, str], width: int, *, publishing: bool
) -> list[str]:
    """The topics of one direction with the nodes at their other ends, as words that fill lines."""
    words: list[str] = []
    lonely: list[str] = []
    for each in ends:
        if is_hidden(each.name, TOOL_NAMES):
            continue
        others = [one for one in ends_of(info, each.name)[1 if publishing else 0] if "/_" not in one]
        if not others:
            lonely.append(each.name)
            continue
        rate = f" {rates[each.name]}" if rates.get(each.name) else ""
        arrow = "→" if publishing else "←"
        words.append(f"{each.name}{rate} {arrow} {' '.join(others)}")
    if lonely:
        words.append(named("no subscriber:" if publishing else "no publisher:", lonely, width - INDENT - 1))
    lines: list[str] = []
    for word in words:
        if lines and cell_len(lines[-1]) + len(GAP) * 2 + cell_len(word) <= width:
            lines[-1] += GAP * 2 + word
        else:
            lines.append(f"{verb if not lines else '':<{INDENT}}{word}")
    return lines


def _link_notes(info: GraphInfo, links: Iterable[str], rates: Mapping[str, str], width: int, maximum: int) -> list[str]:
    """The topics of a line with their ends, in at most so many lines."""
    lines: list[str] = []
    for link in links:
        name = link.partition(":")[2]
        if not link.startswith(TOPIC):
            lines.append(link.replace(":", " ", 1))
            continue
        publishers, subscribers = ends_of(info, name)
        rate = f" {rates[name]}" if rates.get(name) else ""
        lines.append(f"{name}{rate}{GAP}{' '.join(publishers)} → {' '.join(subscribers)}")
    if len(lines) > maximum:
        lines = [*lines[: maximum - 1], f"{len(lines) - maximum + 1} more"] if maximum > 0 else []
    return [cut(sanitize(each), width) for each in lines]
