"""The current arrangement: a named layout, the changes made to it, and their undo history."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from bot_console.tui.layout.built_in import BUILT_IN, OVERVIEW, Layout
from bot_console.tui.layout.placing import Box, boxes, fits
from bot_console.tui.layout.tree import Tree, close, exchange, panes

CHROME_ROWS = 3
"""Lines of the screen that do not belong to panes: tabs, status, keys."""
MAX_TERMINAL_CELLS = 1000
"""An upper limit for the columns and lines of any terminal."""
MAX_UNDO_STEPS = 50
"""Changes that can be undone."""


IN_PLACE_OF_EMPTY = "graph"
"""The pane that takes the place of one that would stay empty, unless it is on the screen already."""


def without_pane(tree: Tree, pane: str) -> Tree:
    """The tree without a pane: `IN_PLACE_OF_EMPTY` takes its place, or else its neighbours grow."""
    shown = panes(tree)
    if pane not in shown:
        return tree
    return close(tree, pane) or tree if IN_PLACE_OF_EMPTY in shown else exchange(tree, pane, IN_PLACE_OF_EMPTY)


class LayoutStore(Protocol):
    """Where layouts are stored."""

    def layouts(self) -> Mapping[str, Layout]:
        """The user's layouts by name, without those that cannot be read."""
        ...

    def save(self, name: str, tree: Tree) -> str:
        """Save a tree under a name and return the file; raises `NotSaved`."""
        ...

    def remember(self, name: str, tree: Tree | None) -> None:
        """Save what the screen shows at the end: the layout's name, and its tree if it was changed; never raises."""
        ...


class MemoryLayoutStore:
    """A store that keeps layouts only while the program runs."""

    def __init__(self) -> None:
        self.kept: dict[str, Layout] = {}

    def layouts(self) -> Mapping[str, Layout]:
        """The layouts saved so far."""
        return self.kept

    def save(self, name: str, tree: Tree) -> str:
        """Keep a tree."""
        self.kept[name] = Layout(tree)
        return name

    def remember(self, name: str, tree: Tree | None) -> None:
        """Do nothing: this store does not outlast the program."""


class Arrangement:
    """The layout on the screen, its changes, and their undo history."""

    def __init__(self, store: LayoutStore | None = None, name: str = OVERVIEW, tree: Tree | None = None) -> None:
        """Begin with a layout, or with a tree derived from it; raises `LookupError` for an unknown name."""
        self._store = store or MemoryLayoutStore()
        self._known: Mapping[str, Layout] = {}
        self._changed = tree
        self.empty: frozenset[str] = frozenset()
        """Panes that would stay empty in this system, and whose places go to others."""
        self._before: list[tuple[str, Tree | None]] = []
        if tree is None and name not in self.layouts():
            raise LookupError(f"there is no layout '{name}'; layouts: {', '.join(sorted(self.layouts()))}")
        self.name = name

    def layouts(self) -> Mapping[str, Layout]:
        """All layouts; one of the user's takes precedence over a built-in one of the same name."""
        self._known = {**BUILT_IN, **self._store.layouts()}
        return self._known

    @property
    def title(self) -> str:
        """The layout's name, with a star if it was changed."""
        return f"{self.name}{'*' if self._changed is not None else ''}"

    def tree(self, width: int, height: int) -> Tree | None:
        """The tree for a terminal of a size in cells; None if not all of it fits."""
        tree = self._changed if self._changed is not None else self._layout().form(width, height)
        for pane in self.empty:
            tree = without_pane(tree, pane)
        return tree if fits(boxes(tree, Box(0, 0, width, height - CHROME_ROWS))) else None

    def min_size(self) -> tuple[int, int]:
        """The minimum columns and lines of a terminal that can show it."""
        columns = next(
            (each for each in range(1, MAX_TERMINAL_CELLS) if self.tree(each, MAX_TERMINAL_CELLS) is not None),
            MAX_TERMINAL_CELLS,
        )
        return columns, next(
            (each for each in range(1, MAX_TERMINAL_CELLS) if self.tree(columns, each) is not None), MAX_TERMINAL_CELLS
        )

    def _layout(self) -> Layout:
        """The layout as last read from its file, cached, since it is needed for each snapshot."""
        known = self._known or self.layouts()
        return known.get(self.name, BUILT_IN[OVERVIEW])

    def change(self, tree: Tree) -> None:
        """Show another tree, as a separate step for undo."""
        self._note()
        self._changed = tree

    def drag(self, tree: Tree) -> None:
        """Show another tree within the same undo step, while a border is being dragged."""
        self._changed = tree

    def load(self, name: str) -> None:
        """Show a layout as it was saved; raises `LookupError` for an unknown name."""
        if name not in self.layouts():
            raise LookupError(f"there is no layout '{name}'")
        self._note()
        self.name, self._changed = name, None

    def undo(self) -> bool:
        """Undo the last change; False if there is none."""
        if not self._before:
            return False
        self.name, self._changed = self._before.pop()
        return True

    def save(self, name: str, tree: Tree) -> str:
        """Save the current tree as a layout, which becomes the current one; raises `NotSaved`."""
        kept = self._store.save(name, tree)
        self.layouts()
        self._note()
        self.name, self._changed = name, None
        return kept

    def remember(self) -> None:
        """Save what the screen shows, for the next start."""
        self._store.remember(self.name, self._changed)

    def _note(self) -> None:
        self._before = [*self._before[1 - MAX_UNDO_STEPS :], (self.name, self._changed)]
