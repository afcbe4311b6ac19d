"""Assigns items to columns, and finds the edges that have to run back to the left. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from bot_console.tui.widgets.diagram.graph import Digraph, Item

Edge = tuple[str, str]


@dataclass(frozen=True)
class Layers:
    """The column of each item, the edges that run to the right, and those that run back."""

    column: Mapping[str, int]
    forward: tuple[Edge, ...]
    back: tuple[Edge, ...]


def layers(graph: Digraph) -> Layers:
    """Break the cycles, then give each item the leftmost column to the right of its predecessors."""
    items = {item.id: item for item in graph.items}
    edges = sorted({(a, b) for a, b in graph.edges if a in items and b in items and a != b})
    loops = tuple((a, b) for a, b in dict.fromkeys(graph.edges) if a == b and a in items)
    rank = _ranks(items, edges)
    forward = tuple(each for each in edges if rank[each[0]] < rank[each[1]])
    back = tuple(each for each in edges if rank[each[0]] >= rank[each[1]]) + loops
    return Layers(_columns(items, forward, rank), forward, back)


def _ranks(items: Mapping[str, Item], edges: list[Edge]) -> dict[str, float]:
    """An order with few backward edges: boxes by their own order, chips right after their predecessors."""
    after: dict[str, set[str]] = {each: set() for each in items}
    before: dict[str, set[str]] = {each: set() for each in items}
    for a, b in edges:
        after[a].add(b)
        before[b].add(a)
    boxes = [each for each, item in items.items() if item.boxed]
    gives = {each: len(after[each]) - len(before[each]) for each in boxes}
    ahead = {each: _boxes_reached(each, after, items) - {each} for each in boxes}
    rank: dict[str, float] = {each: float(at) for at, each in enumerate(greedy_order(boxes, ahead, gives))}
    for each in (one for one, item in items.items() if not item.boxed):
        leading = [rank[one] for one in before[each] if one in rank]
        following = [rank[one] for one in after[each] if one in rank]
        rank[each] = min(leading) + 0.5 if leading else min(following, default=0.0) - 0.5
    return rank


def _boxes_reached(start: str, after: Mapping[str, set[str]], items: Mapping[str, Item]) -> set[str]:
    """The boxes that an item has edges to, directly or through one chip."""
    found: set[str] = set()
    for each in after[start]:
        found |= {each} if items[each].boxed else {one for one in after[each] if items[one].boxed}
    return found


def greedy_order(nodes: Iterable[str], after: Mapping[str, set[str]], gives: Mapping[str, int]) -> list[str]:
    """Order nodes as Eades, Lin and Smyth do: sources first, sinks last, else the largest out-degree minus in-degree.

    `gives`, the number of outgoing minus incoming arrows, breaks ties.
    """
    left = set(nodes)
    ahead = {each: {one for one in after[each] if one in left} for each in left}
    before: dict[str, set[str]] = {each: set() for each in left}
    for a, targets in ahead.items():
        for b in targets:
            before[b].add(a)
    head: list[str] = []
    tail: list[str] = []

    def take(each: str) -> None:
        left.remove(each)
        for one in ahead[each]:
            before[one].discard(each)
        for one in before[each]:
            ahead[one].discard(each)

    while left:
        sources = sorted(each for each in left if not before[each])
        sinks = [] if sources else sorted(each for each in left if not ahead[each])
        if sources:
            head += sources
        elif sinks:
            tail = sinks + tail
        else:
            best = min(left, key=lambda each: (len(before[each]) - len(ahead[each]), -gives[each], each))
            head.append(best)
            sources = [best]
        for each in sources or sinks:
            take(each)
    return head + tail


def _columns(items: Mapping[str, Item], forward: Iterable[Edge], rank: Mapping[str, float]) -> dict[str, int]:
    after: dict[str, list[str]] = {each: [] for each in items}
    column = {each: item.least for each, item in items.items()}
    has_cause: set[str] = set()
    for a, b in forward:
        after[a].append(b)
        has_cause.add(b)
    order = sorted(items, key=lambda each: (rank[each], each))
    for each in order:
        for target in after[each]:
            column[target] = max(column[target], column[each] + 1)
    for each in reversed(order):
        # Items without predecessors move next to their successors, which shortens their arrows.
        if each not in has_cause and after[each]:
            column[each] = max(items[each].least, min(column[target] for target in after[each]) - 1)
    return column
