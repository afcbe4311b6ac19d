"""Handles exceptions in the code of a pane or a screen: only that one ends, and a pane can be reopened."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence

from bot_console.tui.arrangement.pane_maker import PaneMaker
from bot_console.tui.files.crash import reason, save_traceback
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.panes.broken_pane import BrokenPane
from bot_console.tui.panes.pane import Pane
from bot_console.tui.screens.overlay import Overlay
from bot_console.tui.screens.question import QuestionScreen
from textual.app import App
from textual.containers import Container
from textual.dom import DOMNode


class FaultHandler:
    """Ends only the pane or screen at fault, and reopens panes."""

    def __init__(self, app: App[None], maker: PaneMaker, changed: Callable[[], None]) -> None:
        self._app = app
        self._maker = maker
        self._changed = changed
        self.seen: list[Exception] = []
        """All faults that were contained."""
        self._ending: set[Pane] = set()

    def contain(self, error: Exception, culprits: list[DOMNode]) -> bool:
        """End the innermost pane or screen in whose code an exception was raised; return False if there is none."""
        for node in culprits:
            for each in node.ancestors_with_self:
                if isinstance(each, Pane) and not isinstance(each, BrokenPane):
                    self.seen.append(error)
                    self._end_pane(each, error)
                    return True
                if isinstance(each, (Overlay, QuestionScreen)) and each in self._app.screen_stack[1:]:
                    self.seen.append(error)
                    self._end_screens(error)
                    return True
        return False

    def _end_pane(self, pane: Pane, error: Exception) -> None:
        if pane in self._ending:
            return
        self._ending.add(pane)
        pane.display = False
        with contextlib.suppress(Exception):  # `detach` may be faulty too
            pane.detach()
        self._app.call_later(self._replace, pane, self._make_placeholder(pane.id or "", error))

    def _make_placeholder(self, id: str, error: Exception) -> BrokenPane:
        title = next((each.title for each in self._maker.entries() if each.id == id), "")
        return self._maker.make(BrokenPane, id, title=title, why=reason(error), details=save_traceback(error))

    def _end_screens(self, error: Exception) -> None:
        while len(self._app.screen_stack) > 1:
            self._app.pop_screen()
        details = save_traceback(error)
        self._app.notify(f"{reason(error)}{f', details: {details}' if details else ''}", title="Closed")

    async def reopen(self, broken: BrokenPane) -> None:
        """Make the pane again, in the place of its placeholder."""
        entry = next(each for each in self._maker.entries() if each.id == broken.id)
        await self._replace(broken, self.make_pane(entry))

    async def add(self, entries: Sequence[PaneEntry]) -> None:
        """Add the panes of plug-ins after the built-in ones, with a placeholder for each that cannot be made."""
        made = [self.make_pane(entry) for entry in entries]
        for pane in made:
            pane.display = False
        panes = self._app.screen_stack[0].query_one("#panes", Container)
        if panes.is_attached:  # it is not if a signal has ended the app meanwhile
            await panes.mount(*made)
            self._changed()

    def make_pane(self, entry: PaneEntry) -> Pane:
        """Make a pane, or a placeholder that says why it cannot be made."""
        try:
            return self._maker.make(entry.load(), entry.id)
        except Exception as error:  # the code of others, which may not even be importable
            return self._make_placeholder(entry.id, error)

    async def _replace(self, old: Pane, new: Pane) -> None:
        container = self._app.screen_stack[0].query_one("#panes", Container)
        place = container.children.index(old)
        await old.remove()
        await container.mount(new, before=place if place < len(container.children) else None)
        self._ending.discard(old)
        self._changed()
