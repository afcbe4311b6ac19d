"""What launch's events do not report about a running process: CPU, memory, hangs, and code that survives a SIGKILL."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

from bot_console.tui.console.graph.anomalies import debugger_text
from bot_console.tui.text.redraw_interval import is_due

CPU_POLL_S = 1.0
"""Seconds over which CPU usage is measured; at the same moments for all processes, which are drawn together."""

CPU_NOISE = 0.0101
"""An insignificant difference between two shares of a CPU: one percent, by which equally busy processes differ."""

STATE_POLL_S = 0.5
"""Seconds between two checks whether a process is frozen or hangs."""


class Vitals(Protocol):
    """A running process, observed from outside."""

    def cpu_seconds(self) -> float | None:
        """The CPU time it has used (s); None if the system does not report it."""
        ...

    def wanted_seconds(self) -> float | None:
        """How long (s) it has been running or waiting only for a CPU; None if unknown."""
        ...

    def memory_bytes(self) -> int | None:
        """Its resident memory (bytes); None if the system does not report it, or if it has no memory of its own."""
        ...

    def is_stopped(self) -> bool:
        """Whether it is frozen (SIGSTOP, a suspended job, gdb)."""
        ...

    def line_in_debugger(self) -> str | None:
        """The line at which a Python debugger has stopped it, empty if the line is unknown; None if none has."""
        ...

    def holds_lock_in(self) -> str:
        """The line in which C code has held the interpreter lock for 1 s; empty if none has."""
        ...

    def hangs_in(self) -> str:
        """Where its code still runs although it was killed; empty if none does."""
        ...


FROZEN = "is frozen by a signal or a debugger, and does nothing until it receives SIGCONT"
HANGS = "hangs in"
BUSY_SHARE = 0.9
"""From this share of time spent running or ready to run, a process counts as never waiting."""

FindVitals: TypeAlias = Callable[[int], "Vitals | None"]
"""Returns the vitals of a process, given its pid right after the start; None if there are none."""


class Usage:
    """The CPU and memory usage of a process, measured every second."""

    def __init__(self, vitals: Vitals, now: float) -> None:
        self._vitals = vitals
        self._at = now
        self._used = vitals.cpu_seconds()
        self._wanted = vitals.wanted_seconds()
        self.share: float | None = None
        """Its share of a CPU (1.0 is one whole CPU), rounded to whole percent; kept while the difference is at most
        `CPU_NOISE`; None until it is known.
        """
        self.memory: int | None = None
        """MB (10^6 bytes), rounded to tens from 100 on, so that the figure is steady while nothing happens."""
        self.stall_reason = ""
        """Why the process makes no progress; empty if it does."""
        self._asked = now
        self.busy_s = 0.0
        """How long (s) it has been busy: running, or waiting only for a CPU."""

    def poll(self, now: float) -> None:
        """Measure if due; `now` is a monotonic time (s)."""
        if now - self._asked >= STATE_POLL_S:
            self._asked, self.stall_reason = now, self._why_it_stalls()
        passed = now - self._at
        if passed < CPU_POLL_S / 2 or not is_due(self._at, now, CPU_POLL_S):
            return
        used, wanted = self._vitals.cpu_seconds(), self._vitals.wanted_seconds()
        share = _cpu_share(self._used, used, passed)
        busy = max(share or 0.0, _cpu_share(self._wanted, wanted, passed) or 0.0) >= BUSY_SHARE
        if share is None or self.share is None or abs(share - self.share) > CPU_NOISE:
            self.share = share
        self.busy_s = self.busy_s + passed if busy else 0.0
        self._at, self._used, self._wanted = now, used, wanted
        held = self._vitals.memory_bytes()
        self.memory = None if held is None else _rounded_megabytes(held)

    def _why_it_stalls(self) -> str:
        if self._vitals.is_stopped():
            return FROZEN
        line = self._vitals.line_in_debugger()
        if line is not None:
            return debugger_text(line)
        held = self._vitals.holds_lock_in()
        return (
            f"{HANGS} {held}, which holds the interpreter lock: no other Python code of this process runs"
            if held
            else ""
        )


def _cpu_share(before: float | None, after: float | None, passed: float) -> float | None:
    return None if before is None or after is None else round(max(0.0, after - before) / passed, 2)


def _rounded_megabytes(held: int) -> int:
    megabytes = round(held / 1e6)
    return megabytes if megabytes < 100 else round(megabytes, -1)
