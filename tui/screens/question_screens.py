"""The screens for the questions that need more than a line; each is imported on first use."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bot_console.tui.screens.question import QuestionScreen
    from bot_console.tui.widgets.prompt.question import Question

SCREENS = {
    "Confirmation": ("confirm", "ConfirmScreen"),
    "Choice": ("picker", "PickerScreen"),
    "Elements": ("array_editor", "ElementsScreen"),
    "Form": ("launch_arguments", "ArgumentsScreen"),
    "Fill": ("message_form", "FillScreen"),
}
"""The module in this folder and the class of the screen for each kind of question, by the name of its class."""


def screen_for(question: Question[Any]) -> QuestionScreen[Any]:
    """The screen for a question; raises `TypeError` for a kind without one."""
    for kind in type(question).__mro__:
        if kind.__name__ in SCREENS:
            return _screen(*SCREENS[kind.__name__])(question)
    raise TypeError(f"no screen asks a {type(question).__name__}")


def prepare() -> None:
    """Import all these screens, so that no first question has to wait for the import."""
    for module, name in SCREENS.values():
        _screen(module, name)


def _screen(module: str, name: str) -> type[QuestionScreen[Any]]:
    return getattr(importlib.import_module(f"bot_console.tui.screens.{module}"), name)
