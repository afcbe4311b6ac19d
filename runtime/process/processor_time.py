"""How much processor time threads have used, where the system tells it (Linux)."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .thread_state import ThreadState


def thread_seconds(native_id: int) -> float | None:
    """Processor time (s) of a running thread of the real process; None where it is not known."""
    try:
        with open(f"/proc/self/task/{native_id}/stat", "rb") as stat_file:
            fields = stat_file.read().rpartition(b")")[2].split()
    except OSError:  # the thread has ended, or the system has no such folder
        return None
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def total_seconds(states: Iterable[ThreadState]) -> float | None:
    """Processor time (s) of several running threads; None where it is not known."""
    times = [thread_seconds(state.thread.native_id) for state in states if state.thread.native_id is not None]
    known = [time for time in times if time is not None]
    return sum(known) if known or not times else None
