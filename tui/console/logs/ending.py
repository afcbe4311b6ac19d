"""Which log lines are of a process that was being ended on purpose."""

from __future__ import annotations

from collections.abc import Iterable

from bot_console.tui.console.model import ProcessInfo, logger_of


def ends_on_purpose(processes: Iterable[ProcessInfo], arrived: int, logger: str) -> bool:
    """Whether a line of that logger, which `arrived` (ns since the epoch), is of a process whose end was requested.

    A process that has started again since is judged by its new run.
    """
    return any(_was_ending(each, arrived) and _is_of(each, logger) for each in processes)


def _was_ending(process: ProcessInfo, arrived: int) -> bool:
    again = process.started if process.started > process.end_requested else None
    return 0 < process.end_requested <= arrived and (again is None or arrived < again)


def _is_of(process: ProcessInfo, logger: str) -> bool:
    """Whether it is the logger of launch for that process, of one of its nodes, or a child of that."""
    names = map(logger_of, process.nodes)
    return logger == process.label or any(f"{logger}.".startswith(f"{each}.") for each in names)
