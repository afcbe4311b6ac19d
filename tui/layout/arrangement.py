"""How the panes stand now: a layout by its name, what was changed since, and what it was before that."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from bot_console.tui.layout.named import BUILT_IN, OVERVIEW, WIDE, Layout
from bot_console.tui.layout.placing import Box, boxes, fits
from bot_console.tui.layout.tree import Tree

CHROME = 3
"""Lines that are not the panes': tabs, status, keys."""
MOST = 1000
"""Columns and lines of which no terminal has more."""
REMEMBERED = 50
"""Changes that can be taken back."""


class LayoutStore(Protocol):
    """Where layouts are kept."""

    def layouts(self) -> Mapping[str, Layout]:
        """The layouts of the user, by name; those that cannot be read are left out."""
        ...

    def save(self, name: str, tree: Tree) -> str:
        """Keep a tree under a name and give the file; raises `NotSaved`."""
        ...

    def remember(self, name: str, tree: Tree | None) -> None:
        """Note what is on the screen at the end: a layout, and its tree where that was changed; never raises."""
        ...


class Forgetful:
    """A store that keeps layouts as long as the program runs."""

    def __init__(self) -> None:
        self.kept: dict[str, Layout] = {}

    def layouts(self) -> Mapping[str, Layout]:
        """Those saved so far."""
        return self.kept

    def save(self, name: str, tree: Tree) -> str:
        """Keep a tree."""
        self.kept[name] = Layout(tree)
        return name

    def remember(self, name: str, tree: Tree | None) -> None:
        """Nothing outlasts the program."""


class Arrangement:
    """The layout on the screen, its changes, and the way back."""

    def __init__(self, store: LayoutStore | None = None, name: str = OVERVIEW, tree: Tree | None = None) -> None:
        """Begin with a layout, or with a tree that was made from it; raises `LookupError` for an unknown name."""
        self._store = store or Forgetful()
        self._known: Mapping[str, Layout] = {}
        self._changed = tree
        self._before: list[tuple[str, Tree | None]] = []
        if tree is None and name not in self.layouts():
            raise LookupError(f"there is no layout '{name}'; layouts: {', '.join(sorted(self.layouts()))}")
        self.name = name

    def layouts(self) -> Mapping[str, Layout]:
        """All layouts there are; one of the user's stands before one of the same name that comes with the console."""
        self._known = {**BUILT_IN, **self._store.layouts()}
        return self._known

    @property
    def title(self) -> str:
        """The layout's name, with a star where it was changed."""
        return f"{self.name}{'*' if self._changed is not None else ''}"

    def tree(self, width: int, height: int) -> Tree | None:
        """What to show in a terminal of so many cells; None where there is too little room for all of it."""
        tree = self._changed
        if tree is None:
            layout = self._layout()
            if width < layout.least[0] or height < layout.least[1]:
                return None
            roomy = width >= WIDE[0] and height >= WIDE[1]
            tree = layout.wide if layout.wide is not None and roomy else layout.tree
        return tree if fits(boxes(tree, Box(0, 0, width, height - CHROME))) else None

    def least(self) -> tuple[int, int]:
        """Columns and lines from which on it is shown."""
        columns = next((each for each in range(1, MOST) if self.tree(each, MOST) is not None), MOST)
        return columns, next((each for each in range(1, MOST) if self.tree(columns, each) is not None), MOST)

    def _layout(self) -> Layout:
        """The layout by the files as they were read last: this is asked for with each snapshot."""
        known = self._known or self.layouts()
        return known.get(self.name, BUILT_IN[OVERVIEW])

    def change(self, tree: Tree) -> None:
        """Show another tree."""
        self._note()
        self._changed = tree

    def drag(self, tree: Tree) -> None:
        """Show another tree without a step of its own: the next of many while a border is dragged."""
        self._changed = tree

    def load(self, name: str) -> None:
        """Show a layout as it was saved; raises `LookupError` for a name that there is not."""
        if name not in self.layouts():
            raise LookupError(f"there is no layout '{name}'")
        self._note()
        self.name, self._changed = name, None

    def undo(self) -> bool:
        """Take the last change back; False where there is none."""
        if not self._before:
            return False
        self.name, self._changed = self._before.pop()
        return True

    def save(self, name: str, tree: Tree) -> str:
        """Keep what is shown under a name, which it has from then on; raises `NotSaved`."""
        kept = self._store.save(name, tree)
        self.layouts()
        self._note()
        self.name, self._changed = name, None
        return kept

    def remember(self) -> None:
        """Let the next start begin with what is on the screen."""
        self._store.remember(self.name, self._changed)

    def _note(self) -> None:
        self._before = [*self._before[1 - REMEMBERED :], (self.name, self._changed)]
