"""The graph to be drawn: items, and directed edges between them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Item:
    """A node to draw: a box with a frame, or (`boxed` false) a chip, which is a name on its line.

    `least` is the leftmost column allowed for it.
    """

    id: str
    label: str
    boxed: bool = True
    least: int = 0


@dataclass(frozen=True)
class Digraph:
    """Items, and edges as pairs of ids; an edge with an end that is not among the items is ignored."""

    items: tuple[Item, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()
