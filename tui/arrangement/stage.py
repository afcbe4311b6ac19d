"""The arrangement on the screen: the layout or a single pane, the focused pane, and the matching tabs and keys."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.keymap import READ_ONLY_WORDS
from bot_console.tui.keys.key import NO_MODE
from bot_console.tui.layout.built_in import OVERVIEW
from bot_console.tui.layout.current_layout import Arrangement
from bot_console.tui.layout.tree import Tree, panes
from bot_console.tui.layout.unused import UnusedPanes
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.screens.question_screens import screen_for
from bot_console.tui.widgets.key_bar import NO_OTHERS, KeyBar
from bot_console.tui.widgets.pane_area import PaneArea
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.tabs import Tab, Tabs
from textual.app import App
from textual.geometry import Size
from textual.widgets import Input, Static

if TYPE_CHECKING:
    from bot_console.tui.arrangement.layout_keys import LayoutEditor
    from bot_console.tui.panes.pane import Pane
    from bot_console.tui.widgets.command_line import CommandField
    from bot_console.tui.widgets.prompt.question import Question

MIN_SIZE = (60, 20)
"""Columns and lines below which only a notice is shown."""
FIRST = "parameters"


class Stage:
    """The panes of an app as they are displayed. It holds no widgets, since a fault may replace some of them."""

    def __init__(
        self, app: App[None], arrangement: Arrangement, wanted: str, newest: Callable[[], ConsoleSnapshot]
    ) -> None:
        self._app = app
        self._newest = newest
        self._wanted = wanted
        self._focused = FIRST
        self._extent = Size(80, 24)
        self._panes: list[Pane] = []
        self._unused = UnusedPanes()
        self._changes = True
        """Whether this console may change anything; if not, the key bar leaves out the keys for that."""
        self.plugins: list[PaneEntry] = []
        """Panes from other packages."""
        self.arrangement = arrangement
        self.opened: set[str] = set()
        """The panes that were shown alone, even for a moment."""

    @cached_property
    def arranging(self) -> LayoutEditor:
        """The object that changes the arrangement; made on first use, so that the first frame need not wait for it."""
        from bot_console.tui.arrangement.layout_keys import LayoutEditor

        return LayoutEditor(self, self.arrangement)

    def entries(self) -> Sequence[PaneEntry]:
        """All available panes."""
        return (*PANES, *self.plugins)

    def panes(self) -> list[Pane]:
        """All panes, in screen order."""
        self._panes = self._panes or cast("list[Pane]", list(self._app.screen_stack[0].query("Pane")))
        return self._panes

    def visible(self) -> list[Pane]:
        """The panes being drawn, from the upper left."""
        order = panes(self._shown())
        seen = (each for each in self.panes() if each.id in order and each.display)
        return sorted(seen, key=lambda each: order.index(each.id or ""))

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Pass a snapshot to all panes, including hidden ones, for events that none may miss."""
        changes = not snapshot.capabilities.change
        if changes != self._changes:
            self._changes = changes
            self.show_keys()
        for pane in self.panes():
            if not pane.is_ending:
                pane.observe(snapshot)

    def drop_unused(self) -> None:
        """Replace a pane that would stay empty by another one, and restore it later; called ten times a second."""
        empty = self._unused.panes(self._newest())
        if empty != self.arrangement.empty:
            self.arrangement.empty = empty
            self.lay_out()

    def current(self) -> Pane | None:
        """The focused pane; if none has the focus, the one chosen last."""
        focused, known = self._app.screen_stack[0].focused, self.panes()
        for widget in focused.ancestors_with_self if focused else ():
            if widget in known:
                return cast("Pane", widget)
        return next((each for each in known if each.id == self._focused), None)

    def cells(self) -> tuple[int, int]:
        """Columns and lines of the terminal."""
        return self._extent.width, self._extent.height

    def is_too_small(self) -> bool:
        """Whether only a notice is shown."""
        return self._extent.width < MIN_SIZE[0] or self._extent.height < MIN_SIZE[1]

    def hides_stops(self) -> bool:
        """Whether no stop can be seen: only a notice is shown, or a box on top of the panes covers the status line."""
        base, *above = self._app.screen_stack
        lines = [each.region for each in base.query(StatusBar)]
        boxes = [each.region for screen in above for each in screen.children]
        return self.is_too_small() or any(box.overlaps(line) for box in boxes for line in lines)

    def selected(self) -> str:
        """The id of the focused pane."""
        pane = self.current()
        return pane.id or "" if pane is not None else ""

    def select(self, pane: str) -> None:
        """Focus a visible pane."""
        for each in self.visible():
            if each.id == pane:
                self._focused = pane
                each.take_focus()
        self.show_keys()

    def ask(self, question: Question[Any]) -> None:
        """Ask a question over the panes."""
        self._app.push_screen(screen_for(question))

    def report(self, text: str) -> None:
        """Show a notification."""
        self._app.notify(text, markup=False)

    def initial_panes(self, size: Size) -> list[tuple[str, str, bool]]:
        """The panes that a terminal of this size shows first: id, title, and whether it gets the focus."""
        shown = self.visible_at(size)
        if self._focused not in shown:
            self._focused = shown[0]
        return [(each.id, each.title, each.id == self._focused) for each in PANES if each.id in shown]

    def visible_at(self, size: Size) -> Sequence[str]:
        """The ids of the panes that a terminal of this size shows; also records the size as that of the screen."""
        self._extent = size
        return panes(self._shown())

    def resized(self, size: Size) -> None:
        """Handle a new size of the terminal."""
        self._extent = size
        self.lay_out()

    def forget_panes(self) -> None:
        """Register a new hidden pane."""
        self._panes = []

    def visible_with(self, name: str) -> Sequence[str]:
        """The ids of the panes that are visible once a pane, or the layout, is chosen."""
        tree = self._tree() if name == OVERVIEW else None
        return panes(tree or (self._focused if name == OVERVIEW else name))

    def changed(self) -> None:
        """Lay out again after a pane was replaced or added."""
        self.forget_panes()
        if self._app.is_running:  # else the screen is being removed
            self.lay_out()

    def go(self, name: str) -> None:
        """Show one pane alone, or the layout."""
        self._wanted = name
        if name != OVERVIEW:
            self._focused = name
            self.opened.add(name)
        elif (tree := self._tree()) is not None and self._focused not in panes(tree):
            self._focused = FIRST if FIRST in panes(tree) else panes(tree)[0]
        self._app.screen_stack[0].set_focus(None)
        self.lay_out()

    def next(self, step: int) -> None:
        """Go to the next pane on the screen (of all if only one is shown), via the parts of a plug-in's widget."""
        now = self.current()
        if now is not None and now.display and now.next_part(step):
            return
        seen = self.visible()
        found = seen if len(seen) > 1 else self.panes()
        target = found[(found.index(now) + step) % len(found)] if now in found else found[0]
        self._focused = target.id or ""
        if target.display:
            target.take_focus()
        else:
            self.go(self._focused)

    def zoom(self) -> None:
        """Show one pane alone, or the layout again."""
        pane = self.current()
        self.go(OVERVIEW if self._wanted != OVERVIEW or pane is None else pane.id or OVERVIEW)

    def lay_out(self) -> None:
        """Show the chosen pane or layout, as far as there is room."""
        screen = self._app.screen_stack[0]
        width, height = self._extent
        small = self.is_too_small()
        screen.set_class(small, "small")
        if small:
            screen.query_one("#too-small", Static).update(too_small(width, height))
        shown = self._shown()
        screen.query_one(PaneArea).place(shown)
        for pane in self.panes():
            before, now = pane.display, pane.id in panes(shown)
            if now:
                pane.make_parts()
            pane.display = now
            if pane.display and not before:
                pane.show(self._newest())
        self._tabs(shown)
        if small:
            screen.set_focus(None)  # keys do what the notice says, and nothing that is hidden
        elif not isinstance(screen.focused, Input):  # whatever lies over the panes has its own focus
            self._focus()
        self.show_keys()

    def _focus(self) -> None:
        lines = cast("list[CommandField]", list(self._app.screen_stack[0].query("CommandField.open")))
        pane = self.current()
        if pane is not None and not pane.display:
            pane = next(iter(self.visible()), None)
        if lines:
            lines[0].take_focus()
        elif pane is not None:
            pane.take_focus()

    def typing(self) -> bool:
        """Whether a text field has the focus."""
        return isinstance(self._app.focused, Input)

    def show_keys(self) -> None:
        """Show the keys of the focused pane."""
        if self._app.screen_stack:
            screen, pane = self._app.screen_stack[0], self.current()
            scopes, typing = pane.scopes if pane else (self._focused,), isinstance(screen.focused, Input)
            words, mode = (pane.key_words, pane.mode) if pane else (NO_OTHERS, NO_MODE)
            words = words if self._changes else {**words, **READ_ONLY_WORDS}
            screen.query_one(KeyBar).show(scopes, typing, self._primary(), self._extent.width, words, mode)

    def recolour(self) -> None:
        """Redraw tabs and keys after a change of theme: their texts contain its colours."""
        if self._app.screen_stack:
            self._tabs(self._shown())
            self.show_keys()

    def _shown(self) -> Tree:
        tree = self._tree() if self._wanted == OVERVIEW else None
        return tree or (self._focused if self._wanted == OVERVIEW else self._wanted)

    def _tree(self) -> Tree | None:
        return self.arrangement.tree(*self.cells())

    def _tabs(self, shown: Tree) -> None:
        together = self._wanted == OVERVIEW and self._tree() is not None
        name = self.arrangement.title
        long, short = (name.capitalize(), "All") if name == OVERVIEW else (name, name)
        tabs = [Tab("0", long, short, OVERVIEW, together)]
        tabs += [
            Tab(each.key, each.title, each.short or each.title, each.id, not together and shown == each.id)
            for each in self.entries()
        ]
        self._app.screen_stack[0].query_one(Tabs).show(tabs, self._extent.width, self._primary())

    def _primary(self) -> str:
        # Textual and Rich call the terminal's own colours by different names.
        return self._app.theme_variables["primary"].removeprefix("ansi_")


def too_small(width: int, height: int) -> str:
    """The notice for a terminal that is too small: at most four short lines."""
    need = f"{MIN_SIZE[0]}x{MIN_SIZE[1]}"
    if width < 40 or height < 6:
        return f"{width}x{height} is too small\n{need} is needed\n! stops the robot\nq quits"
    return f"{width}x{height} is too small\nthe console needs {need}\n\nif the robot moves, ! stops it; q quits"
