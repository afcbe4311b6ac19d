"""The graph to draw: items, and directed edges between them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Item:
    """A node to draw: a box with a frame, or (`boxed` false) a chip, which is a name on its line.

    `least` is the leftmost column in which it may be placed.
    """

    id: str
    label: str
    boxed: bool = True
    least: int = 0


@dataclass(frozen=True)
class Digraph:
    """Items, and edges as pairs of ids; edges to or from unknown items are ignored."""

    items: tuple[Item, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()
