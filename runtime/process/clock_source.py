"""Where all time comes from, and how a thread waits: the seam that makes a stepped run possible."""

from __future__ import annotations

import threading
import time
from typing import Protocol


class Wakeup(Protocol):
    """What a thread of a node process waits on: as `threading.Event`, with deadlines of steady time."""

    def set(self) -> None:
        """Wake the waiter; from any thread, at any time."""
        ...

    def clear(self) -> None:
        """Forget an earlier `set`."""
        ...

    def is_set(self) -> bool:
        """Whether `set` was called since the last `clear`."""
        ...

    def wait(self, deadline_ns: int | None = None) -> bool:
        """Block until set or until steady time reaches the deadline (ns); whether it is set.

        Raises `KeyboardInterrupt` when the node process is stopped meanwhile.
        """
        ...


class ClockSource(Protocol):
    """Steady and system time of one run. All blocking in the runtime goes through `wakeup()` and `sleep_until`."""

    stepped: bool
    """Whether time is virtual."""

    def steady_ns(self) -> int:
        """Monotonic time in ns."""
        ...

    def system_ns(self) -> int:
        """Time since the Unix epoch in ns."""
        ...

    def wakeup(self) -> Wakeup:
        """A new, unset wakeup of this clock source."""
        ...

    def sleep_until(self, deadline_ns: int) -> None:
        """Block until steady time reaches the deadline (ns)."""
        ...


class _RealWakeup:
    """A wakeup on the machine's own clock."""

    __slots__ = ("_event",)

    def __init__(self) -> None:
        self._event = threading.Event()

    def set(self) -> None:
        self._event.set()

    def clear(self) -> None:
        self._event.clear()

    def is_set(self) -> bool:
        return self._event.is_set()

    def wait(self, deadline_ns: int | None = None) -> bool:
        if deadline_ns is None:
            return self._event.wait()
        return self._event.wait(max(0.0, (deadline_ns - time.monotonic_ns()) * 1e-9))


class RealTime:
    """The machine's own clock."""

    stepped = False
    steady_ns = staticmethod(time.monotonic_ns)
    system_ns = staticmethod(time.time_ns)

    def wakeup(self) -> Wakeup:
        """A new, unset wakeup."""
        return _RealWakeup()

    def sleep_until(self, deadline_ns: int) -> None:
        """Block until `time.monotonic_ns()` reaches the deadline."""
        _RealWakeup().wait(deadline_ns)
