"""Recording as the panes see it. Standard library only."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.console.answer import Answer


@dataclass(frozen=True, slots=True)
class RecordingInfo:
    """What is recorded: into which folder (empty: nothing), and how many seconds are kept in memory (0: none)."""

    folder: str = ""
    kept_s: float = 0.0
    problem: str = ""
    """Why recording has ended by itself; empty when all is well."""


@dataclass(frozen=True, slots=True)
class RingSize:
    """How much of what a system carries is kept in memory at most: seconds, and bytes."""

    seconds: float
    bytes: int


class Keeper(Protocol):
    """Keeps the last minutes of a system, wherever that is done."""

    kept_s: float
    """How many seconds."""

    def keep(self, folder: str) -> Future[Answer]:
        """Save them as a new bag, and go on keeping."""
        ...


class Recording(Protocol):
    """Records all topics into a bag, and keeps the last minutes so that what has been can be saved afterwards."""

    @property
    def info(self) -> RecordingInfo:
        """How it stands; the same object until that changes."""
        ...

    def start(self, folder: str) -> Future[Answer]:
        """Record all topics from now on into a new bag folder."""
        ...

    def stop(self) -> Future[Answer]:
        """End the bag; the answer tells how much is in it."""
        ...

    def keep(self, folder: str) -> Future[Answer]:
        """Save the last minutes as a bag, and go on keeping."""
        ...
