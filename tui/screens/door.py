"""The door for questions that need more room than a line: which screen asks which."""

from __future__ import annotations

from typing import Any

from bot_console.tui.screens.confirm import ConfirmScreen
from bot_console.tui.screens.elements import ElementsScreen
from bot_console.tui.screens.fill import FillScreen
from bot_console.tui.screens.launch_arguments import ArgumentsScreen
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.widgets.prompt.question import Choice, Confirmation, Elements, Fill, Form, Question


def screen_for(question: Question[Any]) -> QuestionScreen[Any]:
    """The screen that asks a question; raises `TypeError` for a kind that has none."""
    if isinstance(question, Confirmation):
        return ConfirmScreen(question)
    if isinstance(question, Choice):
        return PickerScreen(question)
    if isinstance(question, Elements):
        return ElementsScreen(question)
    if isinstance(question, Form):
        return ArgumentsScreen(question)
    if isinstance(question, Fill):
        return FillScreen(question)
    raise TypeError(f"no screen asks a {type(question).__name__}")
