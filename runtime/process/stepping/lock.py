"""Locks of a stepped run: a thread that waits for one passes the turn on, which it cannot do in a built-in lock."""

from __future__ import annotations

import threading
from _thread import allocate_lock
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ..node.thread_state import local

if TYPE_CHECKING:
    from ..clock_source import Wakeup

_RealLock = threading.Lock
_RealRLock = threading.RLock


def _in_stepped_run() -> bool:
    clock = local.waits_on
    return clock is not None and clock.stepped


class SteppedLock:
    """Like `threading.Lock`; waiting threads get it in order of arrival."""

    __slots__ = ("__weakref__", "_lock", "_waiters")

    def __init__(self) -> None:
        self._lock: Any = allocate_lock()
        self._waiters: deque[Wakeup] = deque()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Acquire the lock, waiting at most `timeout` s of virtual time; return whether that succeeded."""
        if self._lock.acquire(False):
            return True
        clock = local.waits_on
        if clock is None or not blocking or (timeout <= 0 and timeout != -1):
            return self._lock.acquire(blocking, timeout)  # does not wait, or raises, or belongs to no run
        return self._wait(clock.wakeup(), None if timeout == -1 else clock.steady_ns() + int(timeout * 1e9))

    def _wait(self, turn: Wakeup, deadline: int | None) -> bool:
        self._waiters.append(turn)
        while True:
            try:
                in_time = turn.wait(deadline)
            except BaseException:
                self._give_up(turn)
                raise
            if self._lock.acquire(False):
                self._withdraw(turn)
                return True
            if not in_time:
                self._withdraw(turn)
                return False
            turn.clear()
            self._waiters.appendleft(turn)

    def _withdraw(self, turn: Wakeup) -> None:
        with suppress(ValueError):
            self._waiters.remove(turn)

    def _give_up(self, turn: Wakeup) -> None:
        """Pass on a turn that was granted together with the exception that ended the wait."""
        self._withdraw(turn)
        if turn.is_set() and not self.locked():
            self._call_next()

    def release(self) -> None:
        """Release the lock. Raises `RuntimeError` if it is not held."""
        self._lock.release()
        if self._waiters:
            self._call_next()

    def _call_next(self) -> None:
        with suppress(IndexError):
            self._waiters.popleft().set()

    def locked(self) -> bool:
        """Whether a thread holds it."""
        return self._lock.locked()

    __enter__ = acquire

    def __exit__(self, *_error: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:
        """Release it in a forked child, where the threads that held it or waited for it do not exist."""
        self._lock._at_fork_reinit()
        self._waiters.clear()


class SteppedRLock(SteppedLock):
    """Like `threading.RLock`, for a stepped run.

    The inner built-in lock records its owner atomically when it is acquired, since a finalizer of the same thread may
    run at any time.
    """

    __slots__ = ()

    def __init__(self) -> None:
        self._lock: Any = _RealRLock()
        self._waiters = deque()

    def release(self) -> None:
        """Release it once. Raises `RuntimeError` if the calling thread does not hold it."""
        self._lock.release()
        if self._waiters and not self._is_owned():
            self._call_next()

    def locked(self) -> bool:
        """Whether a thread holds it."""
        if self._is_owned() or not self._lock.acquire(False):
            return True
        self._lock.release()
        return False

    def _recursion_count(self) -> int:
        return self._lock._recursion_count()

    # The methods of its lock that `threading.Condition` needs.

    def _is_owned(self) -> bool:
        return self._lock._is_owned()

    def _release_save(self) -> tuple[int, int]:
        state = self._lock._release_save()
        if self._waiters:
            self._call_next()
        return state

    def _acquire_restore(self, state: tuple[int, int]) -> None:
        self.acquire()
        for _ in range(state[0] - 1):
            self._lock.acquire(False)


class Lock:
    """`threading.Lock`: a lock of the run in the threads of a stepped run, otherwise the built-in one."""

    def __new__(cls) -> Any:
        """Return a new lock for the calling thread."""
        return SteppedLock() if _in_stepped_run() else _RealLock()


class RLock:
    """`threading.RLock`: a lock of the run in the threads of a stepped run, otherwise the built-in one."""

    def __new__(cls) -> Any:
        """Return a new lock for the calling thread."""
        return SteppedRLock() if _in_stepped_run() else _RealRLock()
