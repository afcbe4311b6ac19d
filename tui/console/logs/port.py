"""The port for the system's log and for saved logs, as panes read and search them. Standard library only."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import LogFilter, LoggerLevel, LogRecord, LogState, Severity


class LogNumbers(Protocol):
    """Sequence numbers of log records, in ascending order."""

    def __len__(self) -> int:
        """The number of entries."""
        ...

    def __getitem__(self, index: int, /) -> int:
        """The number at an index; raises `IndexError` beyond the ends."""
        ...

    def place(self, number: int) -> int:
        """The index of the first number that is not less than the given one."""
        ...

    def count(self, index: int, /) -> int:
        """The number of equal records that the entry at an index represents."""
        ...


@dataclass(frozen=True, slots=True)
class LogFindings:
    """The matches of a filter so far, among the records with numbers `begin` to `end` - 1."""

    numbers: LogNumbers
    begin: int = 0
    end: int = 0
    complete: bool = False
    """Whether all records that existed when the search began have been searched."""
    problem: str = ""
    """Why nothing, or not everything, was searched; empty if everything was."""


class LogView(Protocol):
    """A search for the records that match a filter; it runs in the background, newest records first."""

    def poll(self) -> LogFindings:
        """The records found so far; the same object until there is more."""
        ...


class LogSource(Protocol):
    """Records that the Logs pane can show: those of the system, or of a file."""

    @property
    def name(self) -> str:
        """The heading of this source; empty for the system's own log."""
        ...

    @property
    def state(self) -> LogState:
        """Which records are kept; the same object until that changes."""
        ...

    def record(self, seq: int) -> LogRecord | None:
        """The record with that number; None when it was dropped or has not arrived yet."""
        ...

    def view(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Start a search that follows new records; it replaces the search `instead_of`."""
        ...

    def clear(self) -> None:
        """Discard all records; numbering continues."""
        ...

    def close(self) -> None:
        """Stop reading."""
        ...


class Logs(Protocol):
    """The system's log, and the levels of its loggers; `ConsoleSnapshot.logs` says which records are kept."""

    def record(self, seq: int) -> LogRecord | None:
        """The record with that number; None when it was dropped or has not arrived yet."""
        ...

    def matching(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """The numbers, ascending, of the kept records from `after` on that match a filter; with a limit, the newest
        ones.

        Raises `ValueError` with a readable message for a regular expression that does not compile.
        """
        ...

    def view(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Start a search that follows new records; it replaces the search `instead_of`."""
        ...

    def open(self, path: str) -> LogSource:
        """Open a saved log and follow it as it grows; raises `ValueError` with the reason if that fails."""
        ...

    def clear(self) -> None:
        """Discard all records; numbering continues."""
        ...

    def set_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Set the level of a node's logger, or of one of its children; UNSET inherits the parent's level."""
        ...

    def levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's logger and of its children that have logged; raises `ValueError` with the reason."""
        ...
