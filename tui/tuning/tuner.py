"""The protocol by which panes start a tuning; who makes the runs is not their concern."""

from __future__ import annotations

from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.tuning.job import Progress
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting


class Tuning(Protocol):
    """A question being worked on, in the background. Nothing here blocks."""

    @property
    def progress(self) -> Progress:
        """The progress so far; the same object until there is more."""
        ...

    def stop(self) -> None:
        """Stop early; results so far are kept, and the same question resumes from them."""
        ...

    def save(self, name: str, setting: Setting) -> Answer:
        """Save the tuned system, with a setting, as one of the user's profiles."""
        ...


class Tuner(Protocol):
    """Makes runs of the simulated robot."""

    def problem(self, specification: TuningSpecification) -> str:
        """Why a question cannot be answered; empty when it can."""
        ...

    def begin(self, specification: TuningSpecification) -> Tuning:
        """Start, or resume from what is known about the very same question."""
        ...
