"""The runtime's state of each node process thread: its owner, and what is pending to be raised in it."""

from __future__ import annotations

import threading
import time
from _thread import allocate_lock
from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from .. import stack_frames, unpatched

if TYPE_CHECKING:
    from ..clock_source import ClockSource, TurnTaker
    from ..roles import CurrentProcess


IMPORT_POLL_S = 0.005
"""Interval (s) between checks whether a thread has finished importing."""


class ProcessKilled(BaseException):
    """Raised in the threads of a killed node process; no `except Exception` of a node catches it."""


class ThreadState:
    """A thread of a node process, which can be woken, or made to raise an exception.

    A waiting thread is woken and raises by itself; only `throw` interrupts a busy one, so that no exception hits the
    runtime's own work half-way.
    """

    __slots__ = (
        "_guard",
        "_pending",
        "_postponed",
        "_starts",
        "_thrown",
        "_waker",
        "called",
        "clock",
        "daemon",
        "ending",
        "finished",
        "ident",
        "killed",
        "process",
        "task",
        "thread",
        "waits",
    )

    def __init__(self, process: CurrentProcess, clock: ClockSource, thread: threading.Thread) -> None:
        self.process = process
        self.clock = clock
        self.thread = thread
        self.daemon = thread.daemon
        self.finished = clock.wakeup()
        self.task = clock.task(self)
        self.ident = 0
        self.waits = 0
        self.killed = False
        self.called = False
        """Whether anything is pending to be raised or run in this thread."""
        self.ending = False
        """Whether its program has ended: the rest is the runtime's own work, in which nothing is raised."""
        self._guard = allocate_lock()
        self._pending: deque[Callable[[], Any]] = deque()
        self._waker: Callable[[], None] | None = None
        self._thrown = False
        self._starts = False
        """Whether the thread is just starting another one."""
        self._postponed: type[BaseException] | None = None
        """The exception thrown meanwhile."""

    @property
    def waiting(self) -> bool:
        """Whether the thread is in a wait of the runtime, from which it can be woken."""
        return self._waker is not None

    @property
    def takes_turns(self) -> bool:
        """Whether the thread takes turns in a stepped run: then it acts in its turn, however long that takes."""
        return self.task is not None and not self.task.detached

    def enter(self) -> None:
        """Make the calling thread this one, and in a stepped run wait for its turn."""
        self.ident = threading.get_ident()
        local.process = self.process
        local.state = self
        local.waits_on = self.clock
        local.task = self.task
        if self.task is not None:
            self.task.take()

    def leave(self) -> None:
        """End the thread's work: pass the turn on and wake those that join it."""
        if self.ident:
            # The system discards the processor times of a thread that has ended.
            self.process.cpu_of_ended_threads += time.thread_time()
        self.finished.set()
        if self.task is not None:
            self.task.leave()

    def post(self, action: Callable[[], Any]) -> None:
        """Make the thread call `action` in its current or next wait, which raises what the action raises."""
        with self._guard:
            self._pending.append(action)
            self.called = True
            self._wake()

    def kill(self) -> None:
        """Make the thread's current wait and every later one raise `ProcessKilled`."""
        with self._guard:
            self.killed = self.called = True
            self._wake()

    def _wake(self) -> None:
        if self._waker is not None:
            self._waker()

    def take_back(self, action: Callable[[], Any]) -> bool:
        """Withdraw a posted action; returns False if the thread has taken it or, in a wait, is about to."""
        with self._guard:
            if self.waiting or action not in self._pending:
                return False
            self._pending.remove(action)
            self.called = self.killed or bool(self._pending)
            return True

    def throw(self, exception: type[BaseException]) -> None:
        """Raise in the thread; in a busy one at its next bytecode, after any call into C code has returned.

        The import machinery is allowed to finish: an exception within it could be lost, or leave a module's lock held
        for ever, blocking all other node processes.
        """
        with self._guard:
            if self.waiting:
                # It raises by itself when woken; a thrown exception would come at an arbitrary point after the wait.
                self._pending.append(partial(_raise, exception))
                self.called = True
                self._wake()
            elif self.ending:
                return
            elif self._starts:
                self._postponed = exception
            elif self.ident and stack_frames.is_importing(self.ident):
                unpatched.later(IMPORT_POLL_S, partial(self.throw, exception))
            elif self.ident and self.thread.is_alive():
                import ctypes

                self._thrown = True
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(self.ident), ctypes.py_object(exception))

    def start_thread(self, thread: threading.Thread) -> None:
        """Start another thread from this one; an exception thrown meanwhile is raised once the other thread runs.

        Before Python 3.12 a new thread has its starter's identifier until it runs: the exception would end it before
        its first line, and the starter would wait for it for ever.
        """
        try:
            with self._guard:
                self._starts = True
            unpatched.start_thread(thread)
        finally:
            with self._guard:
                self._starts = False
                postponed, self._postponed = self._postponed, None
            if postponed is not None:
                raise postponed

    def begin_wait(self, waker: Callable[[], None]) -> None:
        """Register how to wake the thread from the wait it is entering; raises what was posted or thrown before."""
        with self._guard:
            self._waker = waker
            self.waits += 1
        if self._thrown:
            self._thrown = False
            # An exception thrown while it was busy is raised here, not later in the middle of the wait.
            _checkpoint()
        if self.called:
            self.deliver()

    def end_wait(self) -> None:
        """End the wait: from here on the thread counts as busy."""
        self._waker = None

    def deliver(self) -> None:
        """Run the posted actions in this thread; raises what they raise."""
        while self.called:
            if self.killed:
                raise ProcessKilled
            with self._guard:
                action = self._pending.popleft() if self._pending else None
                self.called = self.killed or bool(self._pending)
            if action is not None:
                action()


def _raise(exception: type[BaseException]) -> None:
    raise exception


def _checkpoint() -> None:
    """Do nothing: the interpreter raises an exception left by `PyThreadState_SetAsyncExc` at a call."""


class _ThreadLocals(threading.local):
    """Thread-local values looked up at every call."""

    process: CurrentProcess
    state: ThreadState | None = None
    task: TurnTaker | None = None
    waits_on: ClockSource | None = None
    """The clock that `time.sleep`, `Condition.wait` and `Thread.join` use; None: the original calls."""


local = _ThreadLocals()
