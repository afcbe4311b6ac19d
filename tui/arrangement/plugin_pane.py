"""Panes from other packages: any Textual widget that takes a `Console`, in the frame of a pane.

A package names them as entry points of the group `bot_console.panes`, `name = module:Class`. The class is called with
the `Console` (`tui/console/protocol.py`). Optional members: `TITLE`, a word for the tabs; `HELP`, the purpose;
`show(snapshot)`, called with each new `ConsoleSnapshot` while the pane is visible; `tick()`, called ten times a second,
also while it is hidden; `detach()`, called when a fault ends it. A subclass of `Pane` is used without a frame.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, cast

from bot_console.tui.arrangement.plugin_console import PluginConsole
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Console
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.panes.pane import Pane
from textual.app import ComposeResult
from textual.widget import Widget


@dataclass(frozen=True, kw_only=True)
class PluginEntry(PaneEntry):
    """A pane from another package; `find` imports its class and may raise anything."""

    find: Callable[[], Any]
    source: str
    """The package that it comes from, for display."""

    def load(self) -> type[Pane]:
        """The pane's class, or a class that frames the widget; raises `TypeError` for anything else."""
        found = self.find()
        if not (isinstance(found, type) and issubclass(found, Widget)):
            raise TypeError(f"{self.source}: {found!r} is not a Textual widget class")
        if issubclass(found, Pane):
            return found
        facts = {
            "TITLE": str(getattr(found, "TITLE", "") or self.title),
            "HELP": str(getattr(found, "HELP", "") or f"A pane of {self.source}."),
            "WIDGET": found,
        }
        return type(found.__name__, (PluginPane,), facts)


class PluginPane(Pane):
    """A frame around another package's widget, which receives snapshots as a pane does."""

    can_focus = True
    WIDGET: ClassVar[Callable[[Console], Widget]]

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._widget = type(self).WIDGET(cast("Console", PluginConsole(self.console)))
        if hasattr(self._widget, "let_go") and not hasattr(self._widget, "detach"):
            name = type(self._widget).__name__
            warnings.warn(f"{name}: rename let_go to detach, its name from now on", FutureWarning, stacklevel=2)

    def compose(self) -> ComposeResult:
        """Fill the frame with the widget."""
        yield self._widget

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Pass the snapshot on."""
        self._forward("show", snapshot)

    def tick(self) -> None:
        """Pass the timer tick on."""
        self._forward("tick")

    def detach(self) -> None:
        """Detach the widget, which is about to be removed."""
        self._forward("detach" if hasattr(self._widget, "detach") else "let_go")

    def focus_target(self) -> None:
        """Focus the first focusable part of the widget, else the frame."""
        next(iter(self._parts()), self).focus()

    def next_part(self, step: int) -> bool:
        """Move the focus within the widget; return False at its last part, where Tab leaves the pane."""
        parts, focused = self._parts(), self.screen.focused
        at = parts.index(focused) + step if focused in parts else -1
        if not 0 <= at < len(parts):
            return False
        parts[at].focus()
        return True

    def _parts(self) -> list[Widget]:
        return [each for each in self.query(Widget) if each.focusable]

    def _forward(self, name: str, *args: object) -> None:
        method = getattr(self._widget, name, None)
        if callable(method):
            method(*args)
