"""What launch's events do not tell of a running process: processor time, and code that survives a SIGKILL."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

PERIOD = 1.0
"""Seconds over which a processor share is measured."""


class Vitals(Protocol):
    """One running process, looked at from outside."""

    def cpu_seconds(self) -> float | None:
        """Processor time that it has used, in s; None where the system does not tell."""
        ...

    def hangs_in(self) -> str:
        """Where code of it still is, although it was killed; empty when there is none."""
        ...


FindVitals: TypeAlias = Callable[[int], "Vitals | None"]
"""Finds the vitals of a process by its pid, right after it was started; None where there are none."""


class ProcessorShare:
    """The share of one processor that a process uses, in whole percent, measured anew every second."""

    def __init__(self, vitals: Vitals, now: float) -> None:
        self._vitals = vitals
        self._at = now
        self._used = vitals.cpu_seconds()
        self._share: float | None = None

    def share(self, now: float) -> float | None:
        """The share (1.0 is one whole processor), at a moment in steady s; None as long as it is not known."""
        if now - self._at >= PERIOD:
            used = self._vitals.cpu_seconds()
            known = used is not None and self._used is not None
            self._share = round(max(0.0, (used or 0.0) - (self._used or 0.0)) / (now - self._at), 2) if known else None
            self._at, self._used = now, used
        return self._share
