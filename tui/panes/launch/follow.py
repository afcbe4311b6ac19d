"""The measurements of the launch pane for each process over time: CPU, warnings and errors, and its newest lines."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

from bot_console.tui.console.model import LogRecord, LogState, ProcessInfo, Severity, logger_of
from bot_console.tui.text.redraw_interval import is_due

CPU_SAMPLE_S = 2.0
"""Seconds between two samples of the CPU usage."""
CPU_SAMPLES = 8
"""Number of samples drawn, one per cell."""
MAX_LINES = 50
"""Maximum number of lines kept per process."""
MAX_RECORDS = 2_000
"""Maximum number of log records read at once; the rest follows with the next snapshot."""
MAX_BACKLOG = 20_000
"""Maximum number of log records read from the time before the pane was opened, or while it was hidden."""


@dataclass(frozen=True)
class OutputLine:
    """A line of the log, and how often it was repeated in a row."""

    record: LogRecord
    """The newest of the repeated records."""
    count: int = 1


@dataclass
class ProcessActivity:
    """The measurements of one process."""

    cpu: deque[float] = field(default_factory=lambda: deque[float](maxlen=CPU_SAMPLES))
    """Samples of CPU usage (1.0 is one full CPU), newest last."""
    warnings: int = 0
    errors: int = 0
    lines: deque[OutputLine] = field(default_factory=lambda: deque[OutputLine](maxlen=MAX_LINES))


class Follower:
    """Gathers measurements from snapshots and the log; while the pane is hidden, only CPU usage is sampled."""

    def __init__(self) -> None:
        self._known: dict[str, ProcessActivity] = {}
        self._info: dict[str, ProcessInfo] = {}
        self._by_logger: dict[str, str] = {}
        """The key of the process that logs or prints under each name."""
        self._processes: object = None
        self._sampled = float("-inf")
        self._cursor = 0

    def of(self, key: str) -> ProcessActivity:
        """The measurements of the process with a key; empty for one that has just appeared."""
        return self._known.get(key) or ProcessActivity()

    def update_processes(self, processes: tuple[ProcessInfo, ...]) -> None:
        """Update the known processes, and the names under which they log."""
        if processes is self._processes:
            return
        self._processes = processes
        self._known = {each.key: self._known.get(each.key) or ProcessActivity() for each in processes}
        self._info = {each.key: each for each in processes}
        names = {logger_of(node): each.key for each in processes for node in each.nodes}
        self._by_logger = {**{each.label: each.key for each in processes}, **names}

    def sample(self, processes: Iterable[ProcessInfo], now: float) -> bool:
        """Sample the CPU usage of each process if a sample is due at `now` (s); returns whether it was."""
        if not is_due(self._sampled, now, CPU_SAMPLE_S):
            return False
        self._sampled = now
        for each in processes:
            if each.key in self._known:
                self._known[each.key].cpu.append(each.cpu or 0.0)
        return True

    def read(self, state: LogState, record: Callable[[int], LogRecord | None]) -> bool:
        """Read new log records; returns whether any came from a known process."""
        if self._cursor > state.end:  # another log
            self._cursor = 0
        begin = max(self._cursor, state.first, state.end - MAX_BACKLOG)
        self._cursor = min(state.end, begin + MAX_RECORDS)
        found = False
        for number in range(begin, self._cursor):
            each = record(number)
            key = self.key_of(each.node) if each is not None else ""
            if each is not None and key:
                self._add(self._known[key], each, is_expected=_is_due_to_requested_end(self._info[key], each))
                found = True
        return found

    def _add(self, followed: ProcessActivity, record: LogRecord, *, is_expected: bool) -> None:
        last = followed.lines.pop() if followed.lines else None
        if last is not None and _same(last.record, record):
            followed.lines.append(OutputLine(record, last.count + 1))
        else:
            followed.lines.extend(each for each in (last, OutputLine(record)) if each is not None)
        followed.errors += record.severity >= Severity.ERROR and not is_expected
        followed.warnings += record.severity == Severity.WARN

    def key_of(self, logger: str) -> str:
        """The process that logs or prints under a name or a parent logger of it; empty if none is known."""
        return _longest(logger, self._by_logger)


def _is_due_to_requested_end(process: ProcessInfo, record: LogRecord) -> bool:
    """Whether a process logged or printed it after its end had been requested; the log counts no such errors either."""
    requested = process.end_requested
    return 0 < requested <= record.stamp and not requested < process.started <= record.stamp


def _same(one: LogRecord, other: LogRecord) -> bool:
    return (one.node, one.severity, one.text) == (other.node, other.severity, other.text)


def _longest(logger: str, keys: Mapping[str, str]) -> str:
    while logger:
        if logger in keys:
            return keys[logger]
        logger = logger.rpartition(".")[0]
    return ""
