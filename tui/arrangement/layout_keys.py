"""Arranging the panes on the screen: which layout is shown, and the keys that change it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Protocol

from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.layout.current_layout import CHROME_ROWS, Arrangement
from bot_console.tui.layout.placing import Box, boxes, fits, neighbour
from bot_console.tui.layout.tree import SplitDirection, Tree, close, even, exchange, panes, resize, split, turn
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.widgets.prompt.question import Choice, Line, Option, Question
from textual.fuzzy import Matcher

STEP = 0.05
"""The fraction of a split by which a key moves a border."""
NAME = re.compile(r"\w[\w .-]{0,40}")


class ArrangingHost(Protocol):
    """The operations of the app that arranging needs."""

    def cells(self) -> tuple[int, int]:
        """Columns and lines of the terminal."""
        ...

    def entries(self) -> Sequence[PaneEntry]:
        """All available panes."""
        ...

    def selected(self) -> str:
        """The focused pane."""
        ...

    def select(self, pane: str) -> None:
        """Focus a pane."""
        ...

    def lay_out(self) -> None:
        """Show the arrangement as it is now."""
        ...

    def ask(self, question: Question[str]) -> None:
        """Ask a question over the panes."""
        ...

    def report(self, text: str) -> None:
        """Show a notification."""
        ...


class LayoutEditor:
    """Carries out the keys of the arranging screen."""

    def __init__(self, screen: ArrangingHost, arrangement: Arrangement) -> None:
        self._screen = screen
        self.arrangement = arrangement

    def begin(self) -> bool:
        """Return whether there is room to arrange panes; if not, say so."""
        if self.tree is not None:
            return True
        self._screen.report(f"Layout '{self.arrangement.name}' {self._needs()}; :layout NAME shows another.")
        return False

    def _needs(self) -> str:
        """A text with the size that the hidden layout needs, and the size of the terminal."""
        least, there = self.arrangement.min_size(), self._screen.cells()
        return f"needs {least[0]}x{least[1]}, this terminal has {there[0]}x{there[1]}"

    @property
    def tree(self) -> Tree | None:
        """What the layout shows in a terminal of this size; None if it does not fit."""
        return self.arrangement.tree(*self._screen.cells())

    def select(self, dx: int, dy: int) -> None:
        """Select the pane in a direction."""
        self._screen.select(self._beside(dx, dy))

    def exchange(self, dx: int, dy: int) -> None:
        """Swap places with the pane in a direction."""
        here, there = self._screen.selected(), self._beside(dx, dy)
        if here != there:
            self._change(lambda tree: exchange(tree, here, there))

    def split(self, direction: SplitDirection) -> None:
        """Ask for a pane and put it beside or below the selected one."""
        here = self._screen.selected()
        self._ask_pane(
            f"Pane {direction} {here}", lambda pane: self._change(lambda tree: split(tree, here, pane, direction), pane)
        )

    def put_another(self) -> None:
        """Ask for a pane and put it in place of the selected one."""
        here = self._screen.selected()
        self._ask_pane(
            f"Pane instead of {here}", lambda pane: self._change(lambda tree: exchange(tree, here, pane), pane)
        )

    def close(self) -> None:
        """Remove the selected pane; the last one stays."""
        here = self._screen.selected()
        self._change(lambda tree: close(tree, here))

    def grow(self, columns: int, lines: int) -> None:
        """Move a border of the selected pane by a step."""
        here = self._screen.selected()
        direction: SplitDirection = "beside" if columns else "below"
        self._change(lambda tree: resize(tree, here, direction, STEP * (columns or lines)))

    def even(self) -> None:
        """Share the space equally."""
        self._change(even)

    def turn(self) -> None:
        """Turn the split of the selected pane, from beside to below or the reverse."""
        here = self._screen.selected()
        self._change(lambda tree: turn(tree, here))

    def undo(self) -> None:
        """Undo the last change."""
        if self.arrangement.undo():
            self._screen.lay_out()
        else:
            self._screen.report("Nothing was changed.")

    def open_layout(self) -> None:
        """Ask for a layout and show it."""
        layouts = self.arrangement.layouts()

        def find(typed: str) -> Sequence[Option]:
            return _best([Option(name, each.about) for name, each in layouts.items()], typed)

        self._screen.ask(Choice("Layouts", self.load, find=find, hint="name", empty="No layout has this name."))

    def load(self, name: str) -> None:
        """Show a layout."""
        self.arrangement.load(name)
        tree = self.tree
        if tree is None:
            self._screen.report(f"'{name}' {self._needs()}; one pane at a time is shown.")
        self._screen.lay_out()

    def name_question(self) -> Line:
        """The question for the name under which to save the current layout."""
        return Line("save as", self.save, text=self.arrangement.name, check=layout_name_problem)

    def save(self, name: str) -> None:
        """Save the current layout under a name."""
        tree = self.tree
        if tree is None:
            return
        try:
            self._screen.report(f"Layout saved: {self.arrangement.save(name.strip(), tree)}")
        except NotSaved as error:
            self._screen.report(f"not saved: {error}")
        self._screen.lay_out()

    def dragged(self, tree: Tree, first: bool) -> None:
        """Adopt the position of a border that was dragged with the mouse."""
        if fits(self._places(tree)):
            (self.arrangement.change if first else self.arrangement.drag)(tree)
            self._screen.lay_out()

    def _beside(self, dx: int, dy: int) -> str:
        tree, here = self.tree, self._screen.selected()
        return neighbour(self._places(tree), here, dx, dy) if tree and here in panes(tree) else here

    def _places(self, tree: Tree) -> dict[str, Box]:
        columns, lines = self._screen.cells()
        return boxes(tree, Box(0, 0, columns, lines - CHROME_ROWS))

    def _change(self, change: Callable[[Tree], Tree | None], select: str = "") -> None:
        before = self.tree
        after = change(before) if before is not None else None
        if before is None or after == before:
            return
        if after is None:
            self._screen.report("The last pane stays.")
        elif not fits(self._places(after)):
            self._screen.report("There is no room for that: a pane needs 20 columns and 4 lines.")
        else:
            self.arrangement.change(after)
            self._screen.lay_out()
            if select:
                self._screen.select(select)

    def _ask_pane(self, label: str, then: Callable[[str], object]) -> None:
        shown = panes(self.tree or "")

        def find(typed: str) -> Sequence[Option]:
            known = [
                Option(each.title, "moves here" if each.id in shown else "", each.id)
                for each in sorted(self._screen.entries(), key=lambda entry: entry.id in shown)
            ]
            return _best(known, typed)

        self._screen.ask(Choice(label, then, find=find, hint="pane", empty="No pane has this name."))


def layout_name_problem(text: str) -> str:
    """Why a text cannot be the name of a layout; empty if it can."""
    return "" if NAME.fullmatch(text.strip()) else "letters, digits, blanks, - and _, at most 40"


def _best(options: Sequence[Option], typed: str) -> Sequence[Option]:
    if not typed.strip():
        return options
    matcher = Matcher(typed.strip())
    scores = [(matcher.match(each.title), each) for each in options]
    return [each for score, each in sorted(scores, key=lambda pair: -pair[0]) if score > 0]
