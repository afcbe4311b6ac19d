"""The placeholder for a pane that ended with an exception."""

from __future__ import annotations

from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.panes.pane import Pane
from bot_console.tui.text.sanitize import sanitize
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.message import Message
from textual.widgets import Static


class BrokenPane(Pane):
    """Shows why a pane has failed, and reopens it."""

    HELP = "A fault in the console has ended this pane. Everything else keeps running; Enter opens it again."
    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("broken")]
    can_focus = True

    class Reopen(Message):
        """Requests the pane to be reopened."""

        def __init__(self, pane: BrokenPane) -> None:
            super().__init__()
            self.pane = pane

    def __init__(self, *args: Any, title: str, why: str, details: str, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.border_title = Text(title)
        self._why = why
        self._details = details

    def compose(self) -> ComposeResult:
        """The reason, and the remedy."""
        text = Text(f"This pane has ended: {sanitize(self._why)}\n\n", "bold")
        text.append("Everything else keeps running; the robot is not affected. Enter opens the pane again.", "not bold")
        text.append(f"\n\nDetails: {sanitize(self._details)}" if self._details else "", "not bold dim")
        yield Static(text)

    def focus_target(self) -> None:
        """Focus the pane itself."""
        self.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Draw nothing."""

    def action_reopen(self) -> None:
        """Request the pane to be reopened."""
        self.post_message(self.Reopen(self))
