"""The built-in layouts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bot_console.tui.layout.tree import Tree, below, beside

OVERVIEW = "overview"


@dataclass(frozen=True)
class Layout:
    """A tree, what it is for, and the columns and lines it needs; in a smaller terminal one pane is shown at a time."""

    tree: Tree
    about: str = ""
    least: tuple[int, int] = (0, 0)
    wide: Tree | None = None
    """What is shown instead where there is much room."""


WIDE = (170, 45)
"""Columns and lines from which the overview has room for the graph as well."""

BUILT_IN: Mapping[str, Layout] = {
    OVERVIEW: Layout(
        below(
            beside("parameters", below("world", "plot", shares=(14, 12))),
            "logs",
            shares=(26, 10),
        ),
        "the robot at a glance",
        least=(100, 30),
        wide=below(
            beside("parameters", below("world", "plot", shares=(5, 4)), "graph", shares=(5, 7, 6)),
            "logs",
            shares=(9, 3),
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
