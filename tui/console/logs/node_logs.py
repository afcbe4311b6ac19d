"""The port for logs: the records of `/rosout` and of processes, searches over them, and the levels of loggers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from concurrent.futures import Future
from functools import partial
from typing import TYPE_CHECKING

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate, refuse
from bot_console.tui.console.logs.port import LogFindings, LogSource, LogView
from bot_console.tui.console.model import (
    LaunchInfo,
    LogFilter,
    LoggerLevel,
    LogRecord,
    LogState,
    ProcessInfo,
    Severity,
    logger_of,
)

if TYPE_CHECKING:
    from bot_console.tui.console.launch.process_output import Add
    from bot_console.tui.console.logs.levels import LoggerLevels
    from bot_console.tui.console.logs.store import LogStore
    from bot_console.tui.console.logs.view import LogViews

NO_RECORDS = LogState()


def _discard(stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
    """Discard a record that arrives before there is a log."""


class _NoNumbers(tuple[int, ...]):
    def place(self, number: int) -> int:
        return 0

    def count(self, index: object) -> int:
        return 0


class _PendingView:
    """A search requested before the log exists: it finds nothing until it can be opened."""

    def __init__(self, logs: NodeLogs, which: LogFilter) -> None:
        self._logs = logs
        self._which = which
        self._view: LogView | None = None

    def poll(self) -> LogFindings:
        """The records found so far."""
        if self._view is None and self._logs.exists:
            self._view = self._logs.view(self._which)
        return self._view.poll() if self._view else LogFindings(_NoNumbers())


class NodeLogs:
    """The log; records that have arrived can be read even after the console has closed."""

    _levels: LoggerLevels
    """Exists after `attach`; only requests that have passed the gate use it."""

    def __init__(self, gate: Gate) -> None:
        self._gate = gate
        self._store: LogStore | None = None
        self.add: Add = _discard
        """Adds a record, in any thread; records added before `begin` are lost."""
        self._views: LogViews | None = None

    def begin(self, store: LogStore | None = None) -> None:
        """Keep records from now on, or read those of a store. Call it in the console's thread: it imports numpy."""
        from bot_console.tui.console.logs.store import LogStore
        from bot_console.tui.console.logs.view import LogViews

        self._store = LogStore() if store is None else store
        self._views = LogViews(self._store)
        self.add = self._store.add

    def attach(self, levels: LoggerLevels) -> None:
        """Provide the loggers' services, once the system has been reached."""
        self._levels = levels

    @property
    def exists(self) -> bool:
        """Whether records can be searched yet."""
        return self._views is not None

    @property
    def state(self) -> LogState:
        """Which records are kept."""
        return self._store.state if self._store else NO_RECORDS

    def discount_errors_of_ending(self, launch: LaunchInfo) -> None:
        """Do not count errors that processes logged or printed after their end had been requested."""
        if self._store is not None and any(each.end_requested for each in launch.processes):
            self._store.discount_errors(partial(_ends_on_purpose, launch.processes))

    def record(self, seq: int) -> LogRecord | None:
        """The record with that number; None if it is not kept."""
        return self._store.record(seq) if self._store else None

    def complaint(self, node: str, since: int) -> str:
        """The last warning or error that a node has logged since the record numbered `since`; empty if none."""
        logger = logger_of(node)
        for seq in range(self.state.end - 1, since - 1, -1):
            record = self.record(seq)
            if record is not None and record.severity >= Severity.WARN and logger_of(record.node) == logger:
                return record.text
        return ""

    def matching(self, which: LogFilter, after: int, limit: int | None = None) -> Sequence[int]:
        """The numbers of the kept records that pass a filter."""
        if self._store is None:
            return ()
        from bot_console.tui.console.logs.search import matching

        return matching(self._store, which, after, limit)

    def view(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Start a search for records that pass a filter; without a log yet, it starts once there is one."""
        return self._views.open(which, instead_of) if self._views else _PendingView(self, which)

    def open(self, path: str) -> LogSource:
        """Read a saved log."""
        from bot_console.tui.console.logs.file import open_log

        return open_log(path)

    def clear(self) -> None:
        """Discard all records."""
        if self._store is not None:
            self._store.clear()

    def set_level(self, node: str, severity: Severity, logger: str = "") -> Future[Answer]:
        """Set a logger's level through the logger service of its node, if it has one."""
        return self._gate.run(lambda: self._levels.set(node, severity, logger), partial(Answer, False))

    def levels(self, node: str) -> Future[tuple[LoggerLevel, ...]]:
        """The levels of a node's loggers."""
        return self._gate.run(lambda: self._levels.of(node), refuse, changes=False)

    def close(self) -> None:
        """Stop searching."""
        if self._views is not None:
            self._views.close()


def _ends_on_purpose(processes: Iterable[ProcessInfo], arrived: int, logger: str) -> bool:
    """Whether a line that `arrived` (ns since the epoch) comes from the logger of a process whose end was requested.

    Lines that arrive after the process has started again do not count.
    """
    return any(_was_being_ended(each, arrived) and _belongs_to(each, logger) for each in processes)


def _was_being_ended(process: ProcessInfo, arrived: int) -> bool:
    again = process.started if process.started > process.end_requested else None
    return 0 < process.end_requested <= arrived and (again is None or arrived < again)


def _belongs_to(process: ProcessInfo, logger: str) -> bool:
    """Whether a logger is launch's logger for the process, that of one of its nodes, or a child of that."""
    names = map(logger_of, process.nodes)
    return logger == process.label or any(f"{logger}.".startswith(f"{each}.") for each in names)
