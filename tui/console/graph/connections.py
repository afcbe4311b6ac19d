"""The graph as lines of text: each topic, service and action with its two sides. Standard library only."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator

from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo

NOBODY = "(none)"

KINDS: tuple[tuple[str, Callable[[NodeInfo], Iterable[Endpoint]], Callable[[NodeInfo], Iterable[Endpoint]]], ...] = (
    ("topic", lambda node: node.publishers, lambda node: node.subscriptions),
    ("service", lambda node: node.clients, lambda node: node.services),
    ("action", lambda node: node.action_clients, lambda node: node.action_servers),
)
"""Each kind of connection with the endpoints from which its arrows start and those at which they end."""


def connections(
    info: GraphInfo, kinds: Iterable[str] = ("topic", "service", "action")
) -> Iterator[tuple[str, str, str]]:
    """Kind, name and text of each connection, sorted by kind and name: `/scan  /lidar → /navigator /monitor`."""
    dead = {*info.silent, *(node for node, _ in info.frozen)}

    def message(nodes: Iterable[str], wrong: Container[str] = ()) -> str:
        words = (f"{'✗' * (each in wrong)}{each}{' (no answer)' * (each in dead)}" for each in sorted(nodes))
        return " ".join(words) or NOBODY

    for kind, give, take in KINDS:
        if kind not in kinds:
            continue
        givers, takers = _by_name(info.nodes, give), _by_name(info.nodes, take)
        for name in sorted(givers.keys() | takers.keys()):
            wrong = {each.subscription for each in info.incompatible.get(name, ())} if kind == "topic" else set[str]()
            what = name if kind == "topic" else f"{kind} {name}"
            yield kind, name, f"{what}  {message(givers.get(name, ()))} → {message(takers.get(name, ()), wrong)}"


def unconnected(nodes: Iterable[NodeInfo], names: Container[tuple[str, str]]) -> list[str]:
    """The nodes that take part in none of the given connections (kind and name)."""
    return [
        node.name
        for node in nodes
        if not any((kind, end.name) in names for kind, give, take in KINDS for end in (*give(node), *take(node)))
    ]


def _by_name(nodes: Iterable[NodeInfo], ends: Callable[[NodeInfo], Iterable[Endpoint]]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for node in nodes:
        for each in ends(node):
            if node.name not in (known := found.setdefault(each.name, [])):
                known.append(node.name)
    return found
