"""The base of questions over the panes."""

from __future__ import annotations

from typing import ClassVar, TypeVar

from bot_console.tui import keymap
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.widgets.prompt.question import Question, Requester
from textual.app import App
from textual.binding import BindingType

A = TypeVar("A")


class QuestionScreen(Requester[A], DimmedScreen):
    """Shows a question until it is answered; closes by itself when its subject has gone."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("question")]
    AUTO_FOCUS = ""

    def __init__(self, question: Question[A]) -> None:
        super().__init__()
        self._question = question

    @property
    def host(self) -> App[object]:
        """The app, with a type that Textual's own property leaves unknown."""
        return self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- Textual's App is generic

    def close(self) -> None:
        """Leave the screen."""
        self.dismiss()

    def report(self, why: str) -> None:
        """Notify the user on the screen below why it closes."""
        self.notify(why, severity="warning", markup=False)

    def action_give_up(self) -> None:
        """Close without an answer."""
        self.give_up()
