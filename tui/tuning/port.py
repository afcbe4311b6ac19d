"""The protocol by which panes start a tuning job, independent of how the runs are made."""

from __future__ import annotations

from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.tuning.job import Progress
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting

NO_TUNER = "Tuning is not available: this console is read-only, or has no simulator."


class Tuning(Protocol):
    """A tuning job in the background. No method blocks."""

    @property
    def progress(self) -> Progress:
        """The progress so far; the same object until there is more."""
        ...

    def stop(self) -> None:
        """Stop early; results so far are kept, and a job with an equal specification resumes from them."""
        ...

    def save(self, name: str, setting: Setting) -> Answer:
        """Save the tuned profile with the values of a setting as one of the user's profiles."""
        ...


class Tuner(Protocol):
    """Starts tuning jobs, which run the simulated robot."""

    def problem(self, specification: TuningSpecification) -> str:
        """Why the specification cannot be run; empty if it can."""
        ...

    def begin(self, specification: TuningSpecification) -> Tuning:
        """Start, or resume from the results of an equal specification."""
        ...
