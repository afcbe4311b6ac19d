"""The layout for a course: the lesson beside the other panes, or in a narrow row below them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bot_console.tui.layout.built_in import Layout
from bot_console.tui.layout.current_layout import LayoutStore
from bot_console.tui.layout.tree import Tree, below, beside, close

NAME = "lesson"
LESSON = Layout(
    below(beside("world", "parameters", shares=(22, 38)), "lesson", shares=(13, 4)),
    "a course beside the robot",
    (
        (
            (140, 36),
            beside(
                below(
                    beside("parameters", below("world", "plot", shares=(14, 12))),
                    "logs",
                    shares=(26, 10),
                ),
                "lesson",
                shares=(5, 2),
            ),
        ),
        ((100, 24), beside(below("parameters", "logs", shares=(3, 2)), "lesson", shares=(61, 39))),
        (
            (80, 24),
            below(
                beside("parameters", below("world", "logs", shares=(10, 7)), shares=(44, 36)), "lesson", shares=(17, 4)
            ),
        ),
    ),
)


@dataclass
class LessonLayoutStore:
    """A layout store with the user's layouts and the one for courses."""

    store: LayoutStore

    def layouts(self) -> Mapping[str, Layout]:
        """All layouts; the user's own take precedence."""
        return {NAME: LESSON, **self.store.layouts()}

    def save(self, name: str, tree: Tree) -> str:
        """Save a tree without the lesson, which a console without a course does not have; raises `NotSaved`."""
        return self.store.save(name, close(tree, NAME) or tree)

    def remember(self, name: str, tree: Tree | None) -> None:
        """Do nothing, so that the user's last layout stays as it was before the course."""
