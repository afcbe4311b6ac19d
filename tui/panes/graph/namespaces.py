"""The ids of what is drawn, and namespaces as boxes: the contents of a folded one are a single item. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from bot_console.tui.text.namespaces import outermost

TOPIC, SERVICE, ACTION = "topic:", "service:", "action:"
LINKS = (TOPIC, SERVICE, ACTION)
"""How the ids of items begin that stand between nodes."""
SPACE = "namespace:"
"""Begins the id of a box that stands for all nodes of a namespace."""
MAX_UNFOLDED_NODES = 40
"""With more nodes, namespaces are folded until a person unfolds them."""


def is_link(item: str) -> bool:
    """Whether an item links nodes: a topic, a service, an action."""
    return item.startswith(LINKS)


def namespace_of(node: str) -> str:
    """The namespace of a node; empty for the root."""
    return node.rpartition("/")[0]


def folds_of(nodes: Sequence[str]) -> frozenset[str]:
    """The namespaces that are folded until a person says otherwise: the outermost ones of many nodes."""
    return outermost(nodes) if len(nodes) > MAX_UNFOLDED_NODES else frozenset()


def unfolded(folded: frozenset[str], space: str, nodes: Iterable[str]) -> frozenset[str]:
    """The namespaces that are folded once one is not: those in it, if it has many nodes."""
    inside = [each for each in nodes if each.startswith(f"{space}/")]
    return folded - {space} | (outermost(inside, space) if len(inside) > MAX_UNFOLDED_NODES else frozenset[str]())


def box_of(node: str, folded: Collection[str]) -> str:
    """The item that represents a node: itself, or the box of its outermost folded namespace."""
    space = namespace_of(node)
    within = [each for each in folded if space == each or space.startswith(f"{each}/")]
    return SPACE + min(within, key=len) if within else node


def folded_edges(
    edges: Iterable[tuple[str, str]], folded: Collection[str], is_link: Collection[str]
) -> tuple[set[tuple[str, str]], set[str]]:
    """Edges between drawn items, and the links (topics, services) within one box, which are not drawn.

    `is_link` are the ids that are not nodes.
    """
    boxes: dict[str, str] = {}

    def box(item: str) -> str:
        if item in is_link:
            return item
        if item not in boxes:
            boxes[item] = box_of(item, folded)
        return boxes[item]

    drawn = {(box(a), box(b)) for a, b in edges}
    ends: dict[str, set[str]] = {}
    for a, b in drawn:
        link, node = (a, b) if a in is_link else (b, a)
        ends.setdefault(link, set()).add(node)
    inside = {link for link, nodes in ends.items() if len(nodes) == 1 and next(iter(nodes)).startswith(SPACE)}
    return {(a, b) for a, b in drawn if a not in inside and b not in inside}, inside
