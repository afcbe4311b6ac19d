"""What a console's panes ask for tuning: who makes the runs is beyond them."""

from __future__ import annotations

from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.tuning.dial import Setting
from bot_console.tui.tuning.question import Question
from bot_console.tui.tuning.study import Progress


class Tuning(Protocol):
    """A question that is worked on beside the thread that draws. Nothing here blocks."""

    @property
    def progress(self) -> Progress:
        """How far it is; the same object until there is more."""
        ...

    def stop(self) -> None:
        """End it early; what was found stays, and the same question goes on there."""
        ...

    def save(self, name: str, setting: Setting) -> Answer:
        """Save the system that was tuned, with a setting, as a profile of the user's."""
        ...


class Tuner(Protocol):
    """Makes runs of the simulated robot."""

    def problem(self, question: Question) -> str:
        """Why a question cannot be worked on; empty when it can."""
        ...

    def begin(self, question: Question) -> Tuning:
        """Begin, or go on with what is known of the very same question."""
        ...
