"""The built-in layouts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.layout.tree import Tree, below, beside

OVERVIEW = "overview"


Size = tuple[int, int]
"""Columns and lines."""


@dataclass(frozen=True)
class Layout:
    """A tree and its purpose; `forms` replace it in terminals of at least a given size, largest first."""

    tree: Tree
    about: str = ""
    forms: Sequence[tuple[Size, Tree]] = ()

    def form(self, width: int, height: int) -> Tree:
        """The tree for a terminal of a size in cells."""
        return next((tree for size, tree in self.forms if width >= size[0] and height >= size[1]), self.tree)


BUILT_IN: Mapping[str, Layout] = {
    OVERVIEW: Layout(
        below(beside("world", "parameters", shares=(22, 38)), "logs", shares=(12, 5)),
        "the robot at a glance",
        (
            (
                (170, 45),
                below(
                    beside("parameters", below("world", "plot", shares=(5, 4)), "graph", shares=(5, 7, 6)),
                    "logs",
                    shares=(9, 3),
                ),
            ),
            (
                (100, 30),
                below(
                    beside("parameters", below("world", "plot", shares=(14, 12))),
                    "logs",
                    shares=(26, 10),
                ),
            ),
            (
                (80, 24),
                below(
                    beside("world", below("plot", "parameters", shares=(7, 8)), shares=(36, 44)),
                    "logs",
                    shares=(15, 6),
                ),
            ),
        ),
    ),
    "my_robot_dashboard": Layout(
        below(beside("parameters", "graph"), beside("logs", "plot"), shares=(3, 2)),
        "parameters, console, plot and node graph, as in rqt's first lesson",
    ),
    "tuning": Layout(beside("parameters", below("plot", "world", shares=(3, 2))), "values and what they do"),
    "driving": Layout(beside(below("world", "logs", shares=(3, 1)), "steering", shares=(3, 2)), "the robot by hand"),
    "watching": Layout(below(beside("graph", "plot"), "logs", shares=(3, 2)), "who talks to whom, and what is said"),
}
