"""The port for profiles, with which the panes preview, apply and save them. Standard library only.

The profiles themselves are in `ConsoleSnapshot.profiles`.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import ProfileDifference, SetOutcome


class Profiles(Protocol):
    """The profiles of all folders."""

    def differences(self, name: str) -> Sequence[ProfileDifference]:
        """The changes that a profile would make if it was applied now."""
        ...

    def apply(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values on the running nodes: all or none. It becomes active unless something was refused.

        A launch profile sets no values: it becomes active once it has been launched. The future raises `ValueError`,
        with the reason, for a profile that does not exist or cannot be used.
        """
        ...

    def open(self, path: str) -> Answer:
        """Add a parameter file as a profile, to preview its changes; the answer is its name, or why that failed."""
        ...

    def fetch(self, address: str) -> Future[Answer]:
        """Add a parameter file from an `https://` address as a profile; the answer is its name, or why that failed."""
        ...

    def save(self, name: str, description: str = "") -> Answer:
        """Save the parameters of all running nodes as one of the user's profiles, with a one-line description."""
        ...

    def rename(self, name: str, to: str) -> Answer:
        """Rename one of the user's profiles; refused for any other profile, and for a name that is taken."""
        ...

    def delete(self, name: str) -> Answer:
        """Delete the file of one of the user's profiles; refused for any other profile."""
        ...
