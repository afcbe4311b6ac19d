"""`signal.alarm` and `signal.setitimer` in a stepped run: the signal arrives in virtual time."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..stepping.own_thread import start_own_thread

if TYPE_CHECKING:
    from ..clock_source import Wakeup
    from ..stepping.scheduler import ScheduledTask
    from ..stepping.stepped_time import SteppedTime


class Alarm:
    """The real-time timer of a process, which `alarm` and `setitimer(ITIMER_REAL)` share."""

    def __init__(self, clock: SteppedTime, send: Callable[[int], None]) -> None:
        """`send(signum)` sends the process a signal."""
        self._clock = clock
        self._send = send
        self._due: int | None = None
        self._interval = 0
        self._changed: Wakeup | None = None
        self._real_setitimer = signal.setitimer
        self._real_getitimer = signal.getitimer

    def alarm(self, seconds: int, /) -> int:
        """`signal.alarm`."""
        before = self._set(seconds * 1_000_000_000, 0)[0]
        return round(before + 0.5)

    def setitimer(self, which: int, seconds: float, interval: float = 0.0, /) -> tuple[float, float]:
        """`signal.setitimer`."""
        if which != signal.ITIMER_REAL or seconds < 0 or interval < 0:
            return self._real_setitimer(which, seconds, interval)  # a timer of processor time, or an invalid call
        return self._set(round(seconds * 1e9), round(interval * 1e9))

    def getitimer(self, which: int, /) -> tuple[float, float]:
        """`signal.getitimer`."""
        return self._left() if which == signal.ITIMER_REAL else self._real_getitimer(which)

    def _left(self) -> tuple[float, float]:
        left = 0.0 if self._due is None else max(0, self._due - self._clock.steady_ns()) * 1e-9
        return left, self._interval * 1e-9

    def _set(self, delay: int, interval: int) -> tuple[float, float]:
        before = self._left()
        self._due = self._clock.steady_ns() + delay if delay else None
        self._interval = interval if delay else 0
        if self._changed is not None:
            self._changed.set()
        elif delay:
            self._changed = self._clock.wakeup()
            start_own_thread(self._clock, self._run)
        return before

    def _run(self, _task: ScheduledTask) -> None:
        assert self._changed is not None
        while True:
            self._changed.clear()
            if self._changed.wait(self._due):
                continue
            self._due = None if not self._interval else self._clock.steady_ns() + self._interval
            self._send(signal.SIGALRM)


def wraps(alarm: Alarm) -> list[tuple[Any, str, Any]]:
    """Return owner, name and replacement of each wrapped call."""
    if not hasattr(signal, "setitimer"):
        return []
    return [(signal, name, getattr(alarm, name)) for name in ("alarm", "setitimer", "getitimer")]
