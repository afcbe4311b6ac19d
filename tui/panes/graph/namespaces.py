"""The ids of drawn items, and folded namespaces, each of which is drawn as a single box. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from bot_console.tui.text.namespaces import foldable_namespaces

TOPIC, SERVICE, ACTION = "topic:", "service:", "action:"
LINKS = (TOPIC, SERVICE, ACTION)
"""Prefixes of the ids of items that link nodes."""
SPACE = "namespace:"
"""Prefix of the id of a box that represents all nodes of a namespace."""
MAX_UNFOLDED_NODES = 40
"""With more nodes than this, namespaces are folded until the user unfolds them."""


def is_link(item: str) -> bool:
    """Whether an item links nodes: a topic, a service, an action."""
    return item.startswith(LINKS)


def namespace_of(node: str) -> str:
    """The namespace of a node; empty for the root."""
    return node.rpartition("/")[0]


def default_folds(nodes: Sequence[str]) -> frozenset[str]:
    """The namespaces that are folded by default: the outermost ones if there are many nodes, otherwise none."""
    return foldable_namespaces(nodes) if len(nodes) > MAX_UNFOLDED_NODES else frozenset()


def unfold(folded: frozenset[str], space: str, nodes: Iterable[str]) -> frozenset[str]:
    """The folded namespaces after unfolding `space`: if it has many nodes, the namespaces inside are folded instead."""
    inside = [each for each in nodes if each.startswith(f"{space}/")]
    return folded - {space} | (
        foldable_namespaces(inside, space) if len(inside) > MAX_UNFOLDED_NODES else frozenset[str]()
    )


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
