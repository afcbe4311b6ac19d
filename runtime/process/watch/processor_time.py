"""The state and the processor time of processes and threads, if the operating system tells them (Linux)."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..roles import NodeThread


ENDED_STATES = ("Z", "X")
"""States of a process that has ended but was not reaped yet."""


def state_and_seconds(task: str) -> tuple[str, float] | None:
    """Return state (`R`, `S`, `D` ..., see proc(5)) and processor time (s) of `/proc/<task>`; None if unknown.

    `task` is a pid, or for a thread a path such as `self/task/123`.
    """
    try:
        with open(f"/proc/{task}/stat", "rb") as stat_file:
            fields = stat_file.read().rpartition(b")")[2].split()
        return fields[0].decode(), (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError):  # it has ended, or the system has no such folder
        return None


def thread_seconds(native_id: int) -> float | None:
    """Return the processor time (s) of a running thread of the real process; None if unknown."""
    reported = state_and_seconds(f"self/task/{native_id}")
    return None if reported is None else reported[1]


def wanted_seconds(task: str) -> float | None:
    """Return how long (s) a thread has run or waited for a processor; None if unknown."""
    reported = ran_and_waited(task)
    return None if reported is None else sum(reported)


def ran_and_waited(task: str) -> tuple[float, float] | None:
    """Return how long (s) a thread has run, and how long it has waited for a processor; None if unknown."""
    try:
        with open(f"/proc/{task}/schedstat", "rb") as file:
            ran, waited = file.read().split()[:2]
    except (OSError, ValueError):  # it has ended, or the system keeps no such count
        return None
    return int(ran) * 1e-9, int(waited) * 1e-9


def total_seconds(states: Iterable[NodeThread]) -> float | None:
    """Return the processor time (s) of several running threads; None if unknown."""
    times = [thread_seconds(state.thread.native_id) for state in states if state.thread.native_id is not None]
    known = [time for time in times if time is not None]
    return sum(known) if known or not times else None
