"""Determine whether a thread makes progress, computes endlessly, or waits for something outside the run.

Elapsed time does not tell: on a busy machine a thread that merely imports a library stalls for seconds. The operating
system (Linux, proc(5)) does: it reports CPU time, whether and where the thread sleeps, and whether it woke.
"""

from __future__ import annotations

import time
from collections.abc import Iterator

from .. import stack_frames
from .processor_time import state_and_seconds

CHECKS_PER_STALL = 4
"""How many checks in a row must find a thread blocked before it counts as blocked."""
SLOW_DISK_FACTOR = 30
"""Factor applied to that number if the thread may be waiting for a slow disk, or if the system tells too little."""
COMPUTING = 10
"""Processor time that a thread may use between two waits, in stalls."""
IMPORTING = 60
"""Processor time that a thread may use for importing libraries, in stalls."""
SLEEPING = "S"
AT_WORK = ("R", "D")


class ThreadWork:
    """The work of one thread of the real process since the first check."""

    def __init__(self, native_id: int, ident: int) -> None:
        self._task = f"self/task/{native_id}"
        self._ident = ident
        self._seconds: float | None = None
        self._switches = ""
        self._family = 0.0
        self._computed = 0.0
        self._imported = 0.0
        self._blocked = 0
        self._factor = 1

    def poll(self) -> None:
        """Check again; call it at even intervals."""
        importing = stack_frames.is_importing(self._ident)
        reported = state_and_seconds(self._task)
        state, seconds = reported or (SLEEPING, time.process_time())
        used = 0.0 if self._seconds is None else seconds - self._seconds
        self._seconds = seconds
        if importing:
            self._imported += used
        else:
            self._computed += used
        if reported is None:
            blocked, self._factor = used == 0.0, 2 * SLOW_DISK_FACTOR
        else:
            blocked = state == SLEEPING and self._is_blocked(importing)
        self._blocked = self._blocked + 1 if blocked else 0

    def is_blocked(self, stalls: int = 1) -> bool:
        """Whether the thread has been waiting in the kernel for that many stalls."""
        return self._blocked >= CHECKS_PER_STALL * self._factor * stalls

    def is_busy(self, stall_s: float, stalls: int = 1) -> bool:
        """Whether the thread has computed for that many stalls of `stall_s` seconds, or imported for many more."""
        limit = COMPUTING * stall_s * stalls
        return self._computed >= limit or self._imported >= IMPORTING / COMPUTING * limit

    def _is_blocked(self, importing: bool) -> bool:
        """Whether a sleeping thread waits for something outside the run.

        A thread that waits for the GIL wakes every few ms, so one that has not woken waits for something else. A thread
        that wakes and sleeps again, because it polls a device, is recognised by where it sleeps: locks are futexes.
        """
        switches, place = self._read("status").partition("\nvoluntary_ctxt_switches:")[2], self._read("wchan")
        still, self._switches = switches == self._switches, switches
        on_lock = place in ("", "0") or place.startswith("futex")
        self._factor = SLOW_DISK_FACTOR if importing and not on_lock else 1
        return (still or not (on_lock or importing)) and not self._any_descendant_works()

    def _any_descendant_works(self) -> bool:
        """Whether a child process or descendant of the thread makes progress; then the thread is waiting for it."""
        reported = [each for each in map(state_and_seconds, _descendants(self._task)) if each]
        before, self._family = self._family, sum(seconds for _, seconds in reported)
        return self._family != before or any(state in AT_WORK for state, _ in reported)

    def _read(self, name: str) -> str:
        return _read(f"/proc/{self._task}/{name}")


def _descendants(task: str) -> Iterator[str]:
    for pid in _read(f"/proc/{task}/children").split():
        yield pid
        yield from _descendants(f"{pid}/task/{pid}")


def _read(path: str) -> str:
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except OSError:  # it has ended, or the system does not tell
        return ""
