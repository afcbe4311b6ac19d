"""A question that is answered with y or n."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui.format import harmless
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static


class ConfirmScreen(ModalScreen[bool]):
    """What is about to happen, and whether it shall."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("y", "answer(True)", "Yes"),
        Binding("n,escape,q", "answer(False)", "No"),
        Binding("exclamation_mark", "app.all_stop", "All stop", show=False),
        Binding("ctrl+q,ctrl+c", "app.quit", "Quit", show=False, priority=True),
    ]
    DEFAULT_CSS = """
    ConfirmScreen { align: center middle; }
    ConfirmScreen VerticalScroll { width: 80%; max-width: 90; height: auto; max-height: 80%; background: $panel;
                                   border: round $warning; padding: 0 1; scrollbar-size-vertical: 1; }
    """

    def __init__(self, question: str, reasons: str = "") -> None:
        super().__init__()
        self._question = question
        self._reasons = reasons

    def compose(self) -> ComposeResult:
        """The question and why it is asked."""
        with VerticalScroll() as box:
            box.border_title = "Really?"
            box.border_subtitle = "y yes · n no"
            text = Text("\n".join(harmless(line) for line in self._reasons.splitlines()))
            text.append(("\n\n" if self._reasons else "") + harmless(self._question), "bold")
            yield Static(text)

    def action_answer(self, yes: bool) -> None:
        """Close with the answer."""
        self.dismiss(yes)
