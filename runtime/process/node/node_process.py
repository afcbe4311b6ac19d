"""A node process: a thread, and the threads it starts, that look like a separate process to their code."""

from __future__ import annotations

import itertools
import os
import signal
import threading
from _thread import allocate_lock
from collections.abc import Callable, Iterable, Mapping, MutableMapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

from .. import stack_frames, unpatched
from ..clock_source import ClockSource
from ..notices import notify
from .capture import NO_INPUT, LineCapture, Sink
from .process_state import ProcessState
from .running import running
from .signals import SIGKILL, Signals
from .thread_state import ProcessKilled, local

if TYPE_CHECKING:
    from ..roles import NodeThread, Pool

_pids = itertools.count((1 << 22) + 1)  # above Linux's highest pid, so that a stray kill() reaches no process
KILL_TIMEOUT_S = 0.5
"""How long (s) a killed process's threads may take to unwind before it counts as abandoned."""


class NodeProcess:
    """A process as its code sees it: arguments, environment, output, signals, exit code, and its own clock source.

    The clock source defaults to that of the process that creates it. `start` runs a callable in it. All other methods
    are thread-safe.
    """

    def __init__(self, name: str, clock: ClockSource | None = None) -> None:
        self.name = name
        self.clock: ClockSource = clock or local.process.clock
        self.locals: dict[Any, Any] = {}
        self.pid = next(_pids)
        self.argv: list[str] = [name]
        self.env: MutableMapping[str, str] = {}
        self.stdin = NO_INPUT
        self.stdout: LineCapture | None = None
        self.stderr: LineCapture | None = None
        self.state = ProcessState.NEW
        self.exit_code: int | None = None
        self.signals = Signals(self)
        self.main_state: NodeThread | None = None
        self.children: dict[threading.Thread, NodeThread] = {}
        self.pools: WeakSet[Pool] = WeakSet()
        self.notices: list[str] = []
        self.overrides: dict[Any, Any] = {}
        self.cpu_of_ended_threads = 0.0
        self._ended = self.clock.wakeup()
        self._exit_lock = allocate_lock()
        self._exit_callbacks: list[Callable[[NodeProcess], Any]] = []
        self._abandon_callbacks: list[Callable[[], Any]] = []

    def start(
        self,
        target: Callable[[], object],
        *,
        argv: Sequence[str] = (),
        env: Mapping[str, str] | None = None,
        stdout: Sink | None = None,
        stderr: Sink | None = None,
    ) -> None:
        """Run `target()` as the main program. Raises `RuntimeError` if the process was started before.

        `argv` is all of `sys.argv`, `env` the whole environment (default: the starter's); `stdout` and `stderr` receive
        each line of output (default: the real streams).
        """
        from ..virtual.install import install_virtual_process
        from .main_thread import start_main_thread

        if self.state is not ProcessState.NEW:
            raise RuntimeError(f"node process {self.name} was already started")
        install_virtual_process()
        self.argv = list(argv) or [self.name]
        self.env = dict(os.environ if env is None else env)
        self.stdout = None if stdout is None else LineCapture(stdout, "<stdout>")
        self.stderr = None if stderr is None else LineCapture(stderr, "<stderr>")
        self.state = ProcessState.RUNNING
        running[self.pid] = self
        start_main_thread(self, target)

    @property
    def is_alive(self) -> bool:
        """Whether the process was started and has not ended."""
        return self.state is ProcessState.RUNNING

    def wait(self, timeout: float | None = None) -> int | None:
        """Block until the process has ended, at most `timeout` s of its clock; return its exit code, or None."""
        deadline = None if timeout is None else self.clock.steady_ns() + int(timeout * 1e9)
        self._ended.wait(deadline)
        return self.exit_code

    def interrupt(self) -> None:
        """Send SIGINT: runs hooks, then raises `KeyboardInterrupt` (or calls its handler) in its main thread.

        The main thread is woken from any wait.
        """
        self.send_signal(signal.SIGINT)

    def terminate(self) -> None:
        """Send SIGTERM: runs hooks or its handler; without either, the process ends with exit code -15."""
        self.send_signal(signal.SIGTERM)

    def deliver_signals(self) -> None:
        """Let pending signals take effect now, if called from the process's main thread.

        For code that has seen the effect of a hook: a real process would have run the handler by now.
        """
        state = local.state
        if state is None or state is not self.main_state:
            return
        # In a stepped run only one thread works at a time, so nothing can be pending; waiting would keep the turn.
        while self.signals.sending and not self.clock.stepped:
            unpatched.sleep(0.0005)
        state.deliver()

    def kill(self) -> None:
        """Send SIGKILL: it ends now with -9; code that does not unwind is abandoned, and a notice names the line."""
        self.send_signal(SIGKILL)

    def send_signal(self, signum: int) -> None:
        """Deliver a signal by number; does nothing if the process has ended."""
        if self.is_alive:
            self.signals.send(int(signum))

    def stop(self, grace: float = 5.0) -> int:
        """Interrupt, terminate, kill, waiting `grace` s of its clock between the steps; return its exit code."""
        for signum in (signal.SIGINT, signal.SIGTERM):
            self.send_signal(signum)
            if self.wait(grace) is not None:
                break
        self.kill()
        return self.exit_code if self.exit_code is not None else -SIGKILL

    def on_interrupt(
        self, callback: Callable[[int], Any], signals: Iterable[int] = (signal.SIGINT, signal.SIGTERM)
    ) -> Callable[[], None]:
        """Call `callback(signum)` before the handler of these signals, in the sender's thread, with this process as
        `current()`.

        A hook for SIGTERM counts as its handler: the process continues. Returns a function that removes the hook.
        """
        return self.signals.add_hook(callback, (int(signum) for signum in signals))

    def on_exit(self, callback: Callable[[NodeProcess], Any]) -> Callable[[], None]:
        """Call `callback(process)` once when the process has ended, newest first; at once if it has already ended.

        Returns a function that removes the callback.
        """
        with self._exit_lock:
            if self.exit_code is None:
                self._exit_callbacks.append(callback)
                return partial(_discard, self._exit_callbacks, callback)
        callback(self)
        return lambda: None

    def end_with_main(self, pool: Pool) -> None:
        """When the main program has ended, let a pool finish its submitted work, shut it down, and wait for that."""
        self.pools.add(pool)

    def on_abandon(self, callback: Callable[[], Any]) -> Callable[[], None]:
        """Call `callback()` when the process has ended in any way, to leave the graph: its code may still be running.

        Called at once if the process has already ended, as a killed thread may get this far. All of these run before
        the first `on_exit` callback. Returns a function that removes the callback.
        """
        with self._exit_lock:
            over = self.exit_code is not None
            if not over:
                self._abandon_callbacks.append(callback)
        if over:
            callback()
        return partial(_discard, self._abandon_callbacks, callback)

    def line(self) -> str | None:
        """Return where its main thread is, as `file.py:12, in function`; None if it has ended."""
        return None if self.main_state is None else stack_frames.thread_line(self.main_state.ident)

    def thread_states(self) -> list[NodeThread]:
        """Return the main thread and the threads it started, except those that have ended."""
        main = [] if self.main_state is None else [self.main_state]
        return [state for state in (*main, *self.children.values()) if state.thread.is_alive()]

    def cpu_seconds(self) -> float | None:
        """Return the processor time (s) its threads have used; None if the system does not tell."""
        from ..watch.processor_time import total_seconds

        running = total_seconds(self.thread_states())
        return None if running is None else self.cpu_of_ended_threads + running

    def guarded(self, callback: Callable[[], Any]) -> None:
        """Call `callback`; turn an exception into a notice, because ending or signalling the process must go on."""
        try:
            callback()
        except Exception as exception:
            notify(self, f"a callback at the end of the process failed: {exception!r}")

    def die(self, code: int) -> None:
        """End now with this exit code, discarding unfinished output; raises `ProcessKilled` in all of its threads."""
        if not self.is_alive:
            return
        states = self.thread_states()
        for capture in (self.stdout, self.stderr):
            if capture is not None:
                # Before the exit is reported: a killed process prints nothing after that.
                capture.mute()
        self.finish(code)
        for state in states:
            state.kill()
        self.break_off_later(states)
        if local.state in states:
            raise ProcessKilled

    def break_off_later(self, states: Sequence[NodeThread]) -> None:
        """Give killed threads a moment to unwind, then raise in those still busy, then report which one hangs where."""
        unpatched.later(KILL_TIMEOUT_S, partial(self._break_off, states))

    def _break_off(self, states: Sequence[NodeThread]) -> None:
        left = [state for state in states if state.thread.is_alive()]
        # A thread waiting for its turn raises by itself when the turn comes; raising in it now would break the order.
        if any(state.takes_turns for state in left):
            self.break_off_later(left)
            return
        for state in left:
            state.throw(ProcessKilled)
        if left:
            unpatched.later(KILL_TIMEOUT_S, partial(self._report_hanging, left))

    def _report_hanging(self, states: Sequence[NodeThread]) -> None:
        for state in states:
            if state.thread.is_alive() and not state.waiting:
                self.state = ProcessState.ABANDONED
                line = stack_frames.thread_line(state.ident)
                notify(self, f"did not end when asked to, so it is abandoned. It hangs in {line}")

    def finish(self, code: int) -> None:
        """Record the end of the process, once, and call all callbacks."""
        with self._exit_lock:
            if self.exit_code is not None:
                return
            self.exit_code = code
        self.state = ProcessState.EXITED
        running.pop(self.pid, None)
        # Whichever thread ends the process, `current()` in the callbacks is the process that has ended.
        before, local.process = local.process, self
        try:
            for abandon in tuple(self._abandon_callbacks):
                self.guarded(abandon)
            for callback in reversed(self._exit_callbacks):
                self.guarded(partial(callback, self))
            for capture in (self.stdout, self.stderr):
                if capture is not None:
                    capture.end()
        finally:
            local.process = before
            self._ended.set()


def _discard(callbacks: list[Any], callback: Any) -> None:
    if callback in callbacks:
        callbacks.remove(callback)
