"""A question that is answered with y or n."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.screens.box import WithScrollBox
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.prompt.question import Confirmation
from rich.cells import cell_len
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import VerticalScroll
from textual.events import Click
from textual.widgets import Static

YES, NO = range(12, 17), range(4, 9)
"""The positions of the two answers in the bottom border, in cells from its right end."""

MAX_TITLE_CELLS = 56
"""Maximum cells of a question that fits into the border at 80 columns; a longer one is repeated inside the box."""


class ConfirmScreen(QuestionScreen[None], WithScrollBox):  # pyright: ignore[reportIncompatibleMethodOverride] # of Textual
    """Asks for confirmation of an action, which the title names."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("confirm")]
    DEFAULT_CSS = """
    ConfirmScreen { align: center middle; }
    ConfirmScreen VerticalScroll { width: 80%; max-width: 90; height: auto; max-height: 80%; background: $panel;
                                   border: round $warning; padding: 0 1; scrollbar-size-vertical: 1; }
    """

    def __init__(self, confirmation: Confirmation) -> None:
        super().__init__(confirmation)
        self._confirmation = confirmation

    def compose(self) -> ComposeResult:
        """The action as the title, and the reasons for asking."""
        reasons = self._confirmation.reasons
        with VerticalScroll(can_focus=False) as box:
            label = sanitize(self._confirmation.label)
            box.border_title = Text(label)
            box.border_subtitle = "y yes · n no"
            text = Text("\n".join(sanitize(line) for line in reasons.splitlines()))
            if cell_len(label) > MAX_TITLE_CELLS:
                text.append(("\n\n" if reasons else "") + label, "bold")
            yield Static(text)

    def on_click(self, event: Click) -> None:
        """Answer the question on a click on an answer; give up on a click outside the box."""
        box = self.query_one(VerticalScroll).region
        if not box.contains(event.screen_x, event.screen_y):
            self.give_up()
        elif event.screen_y == box.bottom - 1:
            from_right = box.right - event.screen_x
            if from_right in YES:
                self.answer(None)
            elif from_right in NO:
                self.give_up()

    def action_yes(self) -> None:
        """Confirm the action."""
        self.answer(None)
