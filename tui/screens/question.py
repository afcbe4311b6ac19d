"""The base of questions over the panes."""

from __future__ import annotations

from typing import ClassVar, TypeVar

from bot_console.tui import keymap
from bot_console.tui.terminal.composing.veil import VeilScreen
from bot_console.tui.widgets.prompt.question import Asker, Question
from textual.app import App
from textual.binding import BindingType

A = TypeVar("A")


class QuestionScreen(Asker[A], VeilScreen):
    """Holds a question until it is answered; leaves the screen by itself when what it is about has left."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("question")]
    AUTO_FOCUS = ""

    def __init__(self, question: Question[A]) -> None:
        super().__init__()
        self._question = question

    @property
    def host(self) -> App[object]:
        """The app; what Textual's own property leaves unsaid of its type is said here once."""
        return self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- Textual's App is generic, and its type is not told

    def close(self) -> None:
        """Leave the screen."""
        self.dismiss()

    def tell(self, why: str) -> None:
        """Say why it closes, on the screen below."""
        self.notify(why, severity="warning", markup=False)

    def action_give_up(self) -> None:
        """Close without an answer."""
        self.give_up()
