"""Everything known about an item of the graph, as options, most of which lead to another item or pane. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from bot_console.tui.console.graph.anomalies import GraphFinding, findings
from bot_console.tui.console.graph.lifecycle_states import TRANSITIONS
from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo
from bot_console.tui.panes.graph.about import node_of, nodes_on_topic, server_types, topic_types
from bot_console.tui.panes.graph.namespaces import ACTION, SERVICE, TOPIC
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.prompt.question import Option

ITEM, DETAIL, PANE, TYPE = "item ", "detail ", "pane ", "type "
"""Prefixes of option values: an item to select, an item whose details to list, a pane and a name in it, a type."""
NODE_ENDS = (
    ("publishes", TOPIC, "publishers"),
    ("subscribes to", TOPIC, "subscriptions"),
    ("serves", SERVICE, "services"),
    ("calls", SERVICE, "clients"),
    ("executes", ACTION, "action_servers"),
    ("sends goals to", ACTION, "action_clients"),
)


def details(snapshot: ConsoleSnapshot, item: str) -> list[Option]:
    """The options of an item: a node's endpoints, parameters and process, or a link's types and nodes."""
    if item.startswith(TOPIC):
        return list(_topic(snapshot.graph, item.removeprefix(TOPIC)))
    if item.startswith((SERVICE, ACTION)):
        return list(_service(snapshot.graph, item))
    return list(_node(snapshot, item))


def _node(snapshot: ConsoleSnapshot, name: str) -> Iterator[Option]:
    node = node_of(snapshot.graph, name)
    if node is None:
        yield Option("The node is no longer running.")
        return
    if name in snapshot.graph.lifecycle:
        state = snapshot.graph.lifecycle[name]
        yield Option(f"lifecycle {state}", "T in the graph changes it" if state in TRANSITIONS else "")
    for verb, kind, field in NODE_ENDS:
        ends: tuple[Endpoint, ...] = getattr(node, field)
        for each in ends:
            about = f"{', '.join(each.types)}  {each.qos}".rstrip()
            yield Option(f"{verb} {each.name}", about, f"{ITEM}{kind}{each.name}")
    tree = snapshot.parameters.get(name)
    for each in tree.parameters if tree else ():
        yield Option(f"parameter {each.name}", f"{value_text(each.value)} {each.unit}", f"{PANE}parameters {name}")
    if tree and tree.problem:
        yield Option("parameters", tree.problem, f"{PANE}parameters {name}")
    for process in snapshot.launch.processes:
        if name in process.nodes:
            pid = f"  pid {process.pid}" if process.pid else ""
            yield Option(f"process {process.label}", f"{process.state.value}{pid}", f"{PANE}launch {name}")
    yield Option("log lines", "of this node", f"{PANE}logs {name}")


def _topic(info: GraphInfo, name: str) -> Iterator[Option]:
    types = topic_types(info, name)
    for each in types:
        yield Option(
            f"type {each}",
            "more than one type: endpoints of different types do not connect" if len(types) > 1 else "",
            TYPE + each,
        )
    qos = {
        (node.name, publishing): each.qos
        for node in info.nodes
        for publishing, ends in ((True, node.publishers), (False, node.subscriptions))
        for each in ends
        if each.name == name
    }
    publishers, subscribers = nodes_on_topic(info, name)
    for word, nodes, publishing in (("published by", publishers, True), ("subscribed by", subscribers, False)):
        for each in nodes:
            yield Option(f"{word} {each}", qos.get((each, publishing), ""), ITEM + each)
        if not nodes:
            yield Option(f"{word} nobody")
    yield Option("rate, messages, publishing", "in the topics pane", f"{PANE}topics {name}")


def line_options(info: GraphInfo, links: Iterable[str]) -> list[Option]:
    """The links that a line represents, with their types and nodes."""
    found: list[Option] = []
    for link in links:
        kind, _, name = link.partition(":")
        if link.startswith(TOPIC):
            publishers, subscribers = nodes_on_topic(info, name)
            about = f"{', '.join(topic_types(info, name))}  {' '.join(publishers)} → {' '.join(subscribers)}"
        else:
            about = " ".join(server_types(info, link))
        found.append(Option(f"{kind} {name}", about, f"{DETAIL}{link}"))
    return found


def _service(info: GraphInfo, item: str) -> Iterator[Option]:
    kind, _, name = item.partition(":")
    given, taken = ("services", "clients") if kind == "service" else ("action_servers", "action_clients")
    for word, field in (("served by", given), ("called by", taken)):
        found = [(node.name, each) for node in info.nodes for each in _named(getattr(node, field), name)]
        for node, each in found:
            yield Option(f"{word} {node}", ", ".join(each.types), ITEM + node)
        if not found:
            yield Option(f"{word} nobody")


def _named(ends: Iterable[Endpoint], name: str) -> list[Endpoint]:
    return [each for each in ends if each.name == name]


def finding_options(info: GraphInfo) -> list[Option]:
    """The findings, each with the item that it concerns."""
    return [Option(each.text, "fault" if each.fault else "", ITEM + _item_of(info, each)) for each in findings(info)]


def _item_of(info: GraphInfo, finding: GraphFinding) -> str:
    subject = finding.subject
    if node_of(info, subject) is not None:
        return subject
    services = {each.name for node in info.nodes for each in (*node.services, *node.clients)}
    actions = {each.name for node in info.nodes for each in (*node.action_servers, *node.action_clients)}
    return (ACTION if subject in actions else SERVICE if subject in services else TOPIC) + subject
