"""Threads that a node process starts belong to it: `Thread.start`, `join`, `is_alive` and the thread lists, wrapped."""

from __future__ import annotations

import sys
import threading
from types import TracebackType
from typing import TYPE_CHECKING

from .. import real
from ..frames import trim
from ..node.thread_state import ProcessKilled, ThreadState, local
from .module_property import VirtualModule, process_variable

if TYPE_CHECKING:
    from ..clock_source import ClockSource
    from ..roles import CurrentProcess

_STATE = "_node_process_state"


def _state_of(thread: threading.Thread) -> ThreadState | None:
    return vars(thread).get(_STATE)


def start_outside(thread: threading.Thread) -> None:
    """Start a thread that belongs to the real process, whoever asks for it."""
    before, local.waits_on = local.waits_on, None  # `Thread.start` waits for the new thread's first sign of life
    try:
        real.start_thread(thread)
    finally:
        local.waits_on = before


def start_inside(
    process: CurrentProcess, clock: ClockSource, thread: threading.Thread, *, child: bool = True
) -> ThreadState:
    """Start a thread that belongs to a node process.

    To the interpreter it is a daemon, so that an abandoned one does not hold up its exit.
    """
    state = ThreadState(process, clock, thread)
    inside = _Inside(state)
    thread.daemon = True
    # On the object: `Thread.start` calls whatever `run` that has, were it of a subclass.
    vars(thread)["run"] = inside
    vars(thread)[_STATE] = state
    if child:
        process.children[thread] = state
    else:
        process.main_state = state
        if state.seat is not None:
            # An import takes wall time and no virtual time: without this others would run ahead of the start.
            state.seat.hold_clock()
    if not process.is_alive:
        # Started by a process that has ended: it ends before its first line.
        state.kill()
    try:
        start_outside(thread)
    except RuntimeError:  # no more threads
        inside.give_up()
        raise
    return state


class VirtualThreading(VirtualModule):
    """The class of `threading` while node processes run."""

    excepthook = process_variable("excepthook", lambda _process: threading.__excepthook__)


class _Inside:
    """`run` of a thread that belongs to a node process."""

    def __init__(self, state: ThreadState) -> None:
        self._state = state
        self._run = state.thread.run
        self._own_run = vars(state.thread).get("run")

    def __call__(self) -> None:
        state = self._state
        self._restore()
        vars(state.thread)["_daemonic"] = state.daemon  # what its own children inherit
        state.enter()
        try:
            self._guarded_run()
        finally:
            state.process.children.pop(state.thread, None)
            state.leave()

    def _guarded_run(self) -> None:
        try:
            self._state.deliver()
            self._run()
        except (SystemExit, ProcessKilled):
            pass
        except BaseException as exception:  # the border of the thread
            trim(exception)
            trace = exception.__traceback__ = _below_bootstrap(exception.__traceback__)
            threading.excepthook(threading.ExceptHookArgs((type(exception), exception, trace, self._state.thread)))

    def _restore(self) -> None:
        own = vars(self._state.thread)
        del own["run"]
        if self._own_run is not None:
            own["run"] = self._own_run

    def give_up(self) -> None:
        """The thread could not be started."""
        self._restore()
        self._state.process.children.pop(self._state.thread, None)
        self._state.leave()


def _below_bootstrap(trace: TracebackType | None) -> TracebackType:
    """The traceback as `threading` would show it: its own frame that called `run` comes first."""
    frame = sys._getframe(3)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    return TracebackType(trace, frame, frame.f_lasti, frame.f_lineno)


def start(thread: threading.Thread) -> None:
    """`Thread.start`: a thread that a node starts belongs to the node's process."""
    clock = local.waits_on
    if clock is None or thread.ident is not None:
        real.start_thread(thread)
    else:
        start_inside(local.process, clock, thread)


def join(thread: threading.Thread, timeout: float | None = None) -> None:
    """`Thread.join`, woken by a signal of the node process, with its clock's time."""
    clock, state = local.waits_on, _state_of(thread)
    if clock is not None and state is not None and state is not local.state:
        deadline = None if timeout is None else clock.steady_ns() + int(max(timeout, 0.0) * 1e9)
        if not state.finished.wait(deadline):
            return
        timeout = None  # the little that is left of the thread is the interpreter's own
    real.join_thread(thread, timeout)


def is_alive(thread: threading.Thread) -> bool:
    """`Thread.is_alive`: false as soon as the node's part of the thread is over."""
    state = _state_of(thread)
    return (state is None or not state.finished.is_set()) and real.is_thread_alive(thread)


def main_thread() -> threading.Thread:
    """`threading.main_thread`: that of the calling node process."""
    state = local.process.main_state
    return real.main_thread() if state is None else state.thread


def enumerate_threads() -> list[threading.Thread]:
    """`threading.enumerate`: of the calling node process only."""
    process = local.process
    if process.main_state is None:
        return real.enumerate_threads()
    return [state.thread for state in process.thread_states()]


def active_count() -> int:
    """`threading.active_count`: of the calling node process only."""
    return len(enumerate_threads())
