"""The port for recording bags, as the panes see it. Standard library only."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, Protocol

from bot_console.tui.console.answer import Answer


@dataclass(frozen=True, slots=True)
class RecordingInfo:
    """The state of recording: the folder (empty: not recording), and how many seconds are kept in memory (0: none)."""

    folder: str = ""
    kept_s: float = 0.0
    problem: str = ""
    """Why recording has ended without a request; empty when all is well."""
    missing: tuple[str, ...] = ()
    """Topics that cannot be recorded because their types are not available here."""


class SnapshotKeeper(Protocol):
    """Keeps the last minutes of a system's messages in memory, in this process or in another one."""

    kept_s: float
    """How many seconds of messages are kept."""

    def keep(self, folder: str) -> Future[Answer]:
        """Save the kept messages as a new bag, and continue keeping."""
        ...


class GenericTypes(Protocol):
    """A service that rclpy lacks: classes for messages whose type has no definition here, as serialized bytes."""

    def generic_class(self, type_name: str, type_hash: str) -> Any:
        """A class with which to receive and publish such messages; raises `ValueError` if there is none."""
        ...

    def type_hash(self, kind: Any) -> str:
        """The type hash of a message class; empty if messages are received whatever their type hash is."""
        ...


class Recording(Protocol):
    """Records all topics into a bag, and keeps the last minutes in memory so that they can be saved afterwards."""

    @property
    def info(self) -> RecordingInfo:
        """The state of recording; the same object until that changes."""
        ...

    def start(self, folder: str) -> Future[Answer]:
        """Record all topics from now on into a new bag folder."""
        ...

    def stop(self) -> Future[Answer]:
        """Close the bag; the answer says how much it contains."""
        ...

    def keep(self, folder: str) -> Future[Answer]:
        """Save the last minutes as a bag, and continue keeping."""
        ...
