"""The graph to be drawn: items, and directed edges between them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Item:
    """A thing to draw: a box with a frame, or (`boxed` false) a chip, which is a name standing on its line.

    `least` is the leftmost column it may stand in.
    """

    id: str
    label: str
    boxed: bool = True
    least: int = 0


@dataclass(frozen=True)
class Digraph:
    """Items, and edges as pairs of ids; an edge whose ends are not both among the items is left out."""

    items: tuple[Item, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()
