"""The machine's own clock; a signal to a node process can end waits on it."""

from __future__ import annotations

import threading
import time
from _thread import LockType, allocate_lock, get_ident
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from .node.thread_state import ThreadState, local

if TYPE_CHECKING:
    from .clock_source import WaitingThread, Wakeup

SIGNAL_CHECK_NS = 500_000_000
"""How often (ns) a waiting real main thread checks for signals that another thread has received on its behalf."""
_MAIN_THREAD = threading.main_thread().ident
_monotonic_ns = time.monotonic_ns  # the real one: `time.monotonic_ns` is virtual during a stepped run


class _RealWakeup:
    """A wakeup on the machine's own clock; one lock per wait is cheaper than a condition variable."""

    __slots__ = ("__weakref__", "_set", "_waiters")

    def __init__(self) -> None:
        self._set = False
        self._waiters: list[LockType] = []

    def set(self) -> None:
        self._set = True
        waiters = self._waiters
        while waiters:
            try:
                waiter = waiters.pop()
            except IndexError:  # another thread has set it at the same time
                return
            _release(waiter)

    def clear(self) -> None:
        self._set = False

    def is_set(self) -> bool:
        return self._set

    def wait(self, deadline_ns: int | None = None) -> bool:
        state = local.state
        if state is None:
            return self._set or self._block(deadline_ns)
        if self._set and not state.called:
            return True
        return self._block_wakeable(state, deadline_ns)

    def _block(self, deadline_ns: int | None) -> bool:
        lock = allocate_lock()
        lock.acquire()
        # Enlist first, then check the flag: otherwise a `set` in between would find no waiter and be lost.
        self._waiters.append(lock)
        try:
            return self._set or _acquire_until(lock, deadline_ns)
        finally:
            self._withdraw(lock)

    def _block_wakeable(self, state: ThreadState, deadline_ns: int | None) -> bool:
        while True:
            lock = allocate_lock()
            lock.acquire()
            self._waiters.append(lock)
            try:
                state.begin_wait(partial(_release, lock))
                woken = self._set or _acquire_until(lock, deadline_ns)
            finally:
                state.end_wait()
                # It was woken by `set`, even if `clear` was called before this thread ran again.
                was_set = not self._withdraw(lock)
            if state.called:
                state.deliver()
            if self._set or was_set or not woken:
                return self._set or was_set

    def _withdraw(self, lock: LockType) -> bool:
        """Remove the waiter from the list; returns False if `set` has already done so."""
        try:
            self._waiters.remove(lock)
        except ValueError:
            return False
        return True


def _release(lock: LockType) -> None:
    with suppress(RuntimeError):  # set and interrupted at the same time
        lock.release()


def _acquire_until(lock: LockType, deadline_ns: int | None) -> bool:
    # A signal received by another thread does not end an `acquire` here, although its handler runs in this thread.
    if get_ident() == _MAIN_THREAD:
        while deadline_ns is None or deadline_ns - _monotonic_ns() > SIGNAL_CHECK_NS:
            if lock.acquire(True, SIGNAL_CHECK_NS * 1e-9):
                return True
    if deadline_ns is None:
        return lock.acquire()
    remaining = (deadline_ns - _monotonic_ns()) * 1e-9
    if remaining <= 0:
        return lock.acquire(False)
    return lock.acquire(True, min(remaining, threading.TIMEOUT_MAX))


class RealTime:
    """The machine's own clock."""

    stepped = False
    steady_ns = staticmethod(time.monotonic_ns)
    system_ns = staticmethod(time.time_ns)

    def wakeup(self) -> Wakeup:
        """Return a new, unset wakeup."""
        return _RealWakeup()

    def sleep_until(self, deadline_ns: int) -> None:
        """Block until `time.monotonic_ns()` reaches the deadline."""
        _RealWakeup().wait(deadline_ns)

    def task(self, thread: WaitingThread) -> None:
        """Return None: threads run freely."""
