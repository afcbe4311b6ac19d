"""Give a node process the threads it starts: wraps `Thread.start`, `join`, `is_alive` and the thread lists."""

from __future__ import annotations

import sys
import threading
from types import TracebackType
from typing import TYPE_CHECKING

from .. import unpatched
from ..node.thread_state import ProcessKilled, ThreadState, local
from ..stack_frames import trim
from .module_property import VirtualModule, process_variable

if TYPE_CHECKING:
    from ..clock_source import ClockSource
    from ..roles import CurrentProcess

_STATE = "_node_process_state"


def _state_of(thread: threading.Thread) -> ThreadState | None:
    return vars(thread).get(_STATE)


def start_outside(thread: threading.Thread) -> None:
    """Start a thread that belongs to the real process, whichever process calls this."""
    before, local.waits_on = local.waits_on, None  # `Thread.start` waits until the new thread runs
    try:
        if local.state is None:
            unpatched.start_thread(thread)
        else:
            local.state.start_thread(thread)
    finally:
        local.waits_on = before


def start_inside(
    process: CurrentProcess, clock: ClockSource, thread: threading.Thread, *, child: bool = True
) -> ThreadState:
    """Start a thread that belongs to a node process.

    To the interpreter it is a daemon, so that an abandoned thread does not block its exit.
    """
    state = ThreadState(process, clock, thread)
    inside = _NodeThreadRun(state)
    thread.daemon = True
    # Set on the object, because `Thread.start` calls its `run`, even in a subclass.
    vars(thread)["run"] = inside
    vars(thread)[_STATE] = state
    if child:
        process.children[thread] = state
    else:
        process.main_state = state
        if state.task is not None:
            # An import takes wall time but no virtual time: other threads would run ahead of the start.
            state.task.hold_clock()
    if not process.is_alive:
        # The process that starts the thread has ended: the thread must end before its first line.
        state.kill()
    try:
        start_outside(thread)
    except RuntimeError:  # the system allows no more threads
        inside.give_up()
        raise
    return state


class VirtualThreading(VirtualModule):
    """The class of the module `threading` while node processes run."""

    excepthook = process_variable("excepthook", lambda _process: threading.__excepthook__)


class _NodeThreadRun:
    """The `run` of a thread that belongs to a node process."""

    def __init__(self, state: ThreadState) -> None:
        self._state = state
        self._run = state.thread.run
        self._own_run = vars(state.thread).get("run")

    def __call__(self) -> None:
        state = self._state
        self._restore()
        vars(state.thread)["_daemonic"] = state.daemon  # its own children inherit it
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
        except BaseException as exception:  # the boundary of the thread
            trim(exception)
            trace = exception.__traceback__ = _below_bootstrap(exception.__traceback__)
            threading.excepthook(threading.ExceptHookArgs((type(exception), exception, trace, self._state.thread)))

    def _restore(self) -> None:
        own = vars(self._state.thread)
        del own["run"]
        if self._own_run is not None:
            own["run"] = self._own_run

    def give_up(self) -> None:
        """Clean up after a thread that could not be started."""
        self._restore()
        self._state.process.children.pop(self._state.thread, None)
        self._state.leave()


def _below_bootstrap(trace: TracebackType | None) -> TracebackType:
    """Return the traceback as `threading` would show it, starting with the frame of `threading` that called `run`."""
    frame = sys._getframe(3)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    return TracebackType(trace, frame, frame.f_lasti, frame.f_lineno)


def start(thread: threading.Thread) -> None:
    """`Thread.start`: a thread started by a node belongs to the node's process."""
    clock = local.waits_on
    if clock is None or thread.ident is not None:
        unpatched.start_thread(thread)
    else:
        start_inside(local.process, clock, thread)


def join(thread: threading.Thread, timeout: float | None = None) -> None:
    """`Thread.join`: woken by signals of the node process, in its clock's time."""
    clock, state = local.waits_on, _state_of(thread)
    if clock is not None and state is not None and state is not local.state:
        deadline = None if timeout is None else clock.steady_ns() + int(max(timeout, 0.0) * 1e9)
        if not state.finished.wait(deadline):
            return
        timeout = None  # the remaining work is the interpreter's own, and short
    unpatched.join_thread(thread, timeout)


def is_alive(thread: threading.Thread) -> bool:
    """`Thread.is_alive`: False once the node's part of the thread has ended."""
    state = _state_of(thread)
    return (state is None or not state.finished.is_set()) and unpatched.is_thread_alive(thread)


def main_thread() -> threading.Thread:
    """`threading.main_thread`: the main thread of the calling node process."""
    state = local.process.main_state
    return unpatched.main_thread() if state is None else state.thread


def enumerate_threads() -> list[threading.Thread]:
    """`threading.enumerate`: only threads of the calling node process."""
    process = local.process
    if process.main_state is None:
        return unpatched.enumerate_threads()
    return [state.thread for state in process.thread_states()]


def active_count() -> int:
    """`threading.active_count`: only threads of the calling node process."""
    return len(enumerate_threads())
