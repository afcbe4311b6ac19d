"""What launch's events do not tell about a running process: CPU time, and code that survives a SIGKILL."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

CPU_POLL_S = 1.0
"""Seconds over which a processor share is measured."""


STATE_POLL_S = 0.5
"""Seconds between two looks at whether it is frozen, or hangs."""


class Vitals(Protocol):
    """One running process, observed from outside."""

    def cpu_seconds(self) -> float | None:
        """The CPU time it has used (s); None if the system does not tell."""
        ...

    def wanted_seconds(self) -> float | None:
        """How long (s) it has run or waited for a CPU, and for nothing else; None if unknown."""
        ...

    def memory_bytes(self) -> int | None:
        """Its main memory; None if the system does not tell, or if it has none of its own."""
        ...

    def is_stopped(self) -> bool:
        """Whether it is frozen (SIGSTOP, a debugger, a suspended job)."""
        ...

    def holds_lock_in(self) -> str:
        """The line in which C code has held its interpreter lock for 1 s; empty if none does."""
        ...

    def hangs_in(self) -> str:
        """Where its code still runs although it was killed; empty if none does."""
        ...


FROZEN = "is frozen by a signal or a debugger, and hears nothing until SIGCONT"
HANGS = "hangs in"
BUSY_SHARE = 0.9
"""The share of wall time from which a process counts as one that never waits, on a processor or for one."""

FindVitals: TypeAlias = Callable[[int], "Vitals | None"]
"""Finds the vitals of a process by its pid, right after it was started; None where there are none."""


class Usage:
    """What a process uses, measured every second: its share of one CPU, and its memory."""

    def __init__(self, vitals: Vitals, now: float) -> None:
        self._vitals = vitals
        self._at = now
        self._used = vitals.cpu_seconds()
        self._wanted = vitals.wanted_seconds()
        self.share: float | None = None
        """1.0 is one whole processor, in whole percent; None as long as it is not known."""
        self.memory: int | None = None
        """MB (10^6 bytes), with two digits from 100 on so that it stands still while nothing happens."""
        self.stands = ""
        """Why nothing of it runs; empty where it does."""
        self._asked = now
        self.busy_s = 0.0
        """How long (s) it has not waited for anything but a processor."""

    def poll(self, now: float) -> None:
        """Measure if it is due; the argument is a steady time (s)."""
        if now - self._asked >= STATE_POLL_S:
            self._asked, self.stands = now, self._why_it_stands()
        passed = now - self._at
        if passed < CPU_POLL_S:
            return
        used, wanted = self._vitals.cpu_seconds(), self._vitals.wanted_seconds()
        self.share = _share(self._used, used, passed)
        busy = max(self.share or 0.0, _share(self._wanted, wanted, passed) or 0.0) >= BUSY_SHARE
        self.busy_s = self.busy_s + passed if busy else 0.0
        self._at, self._used, self._wanted = now, used, wanted
        held = self._vitals.memory_bytes()
        self.memory = None if held is None else _steady(held)

    def _why_it_stands(self) -> str:
        if self._vitals.is_stopped():
            return FROZEN
        held = self._vitals.holds_lock_in()
        return f"{HANGS} {held}, which holds the interpreter's lock: nothing else of it runs" if held else ""


def _share(before: float | None, after: float | None, passed: float) -> float | None:
    return None if before is None or after is None else round(max(0.0, after - before) / passed, 2)


def _steady(held: int) -> int:
    megabytes = round(held / 1e6)
    return megabytes if megabytes < 100 else round(megabytes, -1)
