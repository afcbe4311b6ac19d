"""The focused item of the graph, with a history that can be walked back and forth. Pure."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

EDGES_PER_HOP = 2
"""Edges of one hop: to a topic and on to the node behind it."""


@dataclass(frozen=True)
class Focus:
    """An item and the number of hops drawn around it; without an item everything is drawn."""

    item: str = ""
    hops: int = 1


@dataclass
class FocusHistory:
    """The history of the focus, backwards and forwards."""

    now: Focus = field(default_factory=Focus)
    _behind: list[Focus] = field(default_factory=lambda: [])
    _ahead: list[Focus] = field(default_factory=lambda: [])

    def go(self, item: str) -> None:
        """Focus on an item; focusing on the same one again widens the focus by a hop."""
        wider = self.now.hops + 1 if item == self.now.item else 1
        self._behind.append(self.now)
        self._ahead.clear()
        self.now = Focus(item, wider)

    def back(self) -> bool:
        """Go back to the previous focus; returns whether there was one."""
        return self._move(self._behind, self._ahead)

    def forward(self) -> bool:
        """Go forward to the focus left by `back`; returns whether there was one."""
        return self._move(self._ahead, self._behind)

    def _move(self, source: list[Focus], target: list[Focus]) -> bool:
        if not source:
            return False
        target.append(self.now)
        self.now = source.pop()
        return True


def items_around(focus: Focus, edges: Iterable[tuple[str, str]]) -> set[str]:
    """The items within the hops of a focus, in both directions of the arrows."""
    near: dict[str, set[str]] = {}
    for a, b in edges:
        near.setdefault(a, set()).add(b)
        near.setdefault(b, set()).add(a)
    found = frontier = {focus.item}
    for _ in range(focus.hops * EDGES_PER_HOP):
        frontier = {one for each in frontier for one in near.get(each, ())} - found
        found = found | frontier
    return found
