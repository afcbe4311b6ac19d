"""A node process: a thread, and the threads it starts, that look to their code like a process of their own."""

from __future__ import annotations

import itertools
import os
import signal
import sys
import threading
from _thread import allocate_lock
from collections.abc import Callable, Iterable, Mapping, MutableMapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

from .. import frames, real
from ..clock_source import ClockSource
from ..notices import notify
from .capture import NO_INPUT, LineCapture, Sink
from .process_state import ProcessState
from .running import running
from .signals import SIGKILL, Signals
from .thread_state import ProcessKilled, local

if TYPE_CHECKING:
    from ..roles import NodeThread, OwnModules, Pool

_pids = itertools.count((1 << 22) + 1)  # above Linux's highest possible pid, so that a stray kill() hits nobody
KILL_GRACE_S = 0.5
"""How long (s) a killed process's threads may take to unwind before it counts as abandoned."""


class NodeProcess:
    """A process as its code sees it: arguments, environment, output, signals, exit code, and its own clock source.

    Its clock source is that of the process which makes it unless given. `start` runs a callable in it. All other
    methods may be called from any thread.
    """

    def __init__(self, name: str, clock: ClockSource | None = None) -> None:
        self.name = name
        self.clock: ClockSource = clock or local.process.clock
        self.locals: dict[Any, Any] = {}
        self.pid = next(_pids)
        self.argv: list[str] = [name]
        self.env: MutableMapping[str, str] = {}
        self.path: list[str] = []
        self.cwd: str | None = None
        self.stdin = NO_INPUT
        self.stdout: LineCapture | None = None
        self.stderr: LineCapture | None = None
        self.state = ProcessState.NEW
        self.exit_code: int | None = None
        self.signals = Signals(self)
        self.main_state: NodeThread | None = None
        self.children: dict[threading.Thread, NodeThread] = {}
        self.pools: WeakSet[Pool] = WeakSet()
        self.exit_functions: list[partial[Any]] = []
        self.notices: list[str] = []
        self.modules: OwnModules | None = None
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
        cwd: str | None = None,
    ) -> None:
        """Run `target()` as the main of this process. Raises `RuntimeError` when it was started before.

        `argv` is `sys.argv` whole, `env` the whole environment (default: the starter's), `stdout` and `stderr` get each
        line of output (default: the real streams). `cwd` is where child processes start.
        """
        from ..virtual.install import install_virtual_process
        from ..watch.busy_watch import busy_watch
        from .main_thread import start_main_thread

        if self.state is not ProcessState.NEW:
            raise RuntimeError(f"node process {self.name} was already started")
        install_virtual_process()
        self.argv = list(argv) or [self.name]
        self.env = dict(os.environ if env is None else env)
        self.path = list(sys.path)
        self.stdout = None if stdout is None else LineCapture(stdout, "<stdout>")
        self.stderr = None if stderr is None else LineCapture(stderr, "<stderr>")
        self.cwd = cwd
        self.state = ProcessState.RUNNING
        running[self.pid] = self
        start_main_thread(self, target)
        if not self.clock.stepped:
            busy_watch.watch(self)

    @property
    def is_alive(self) -> bool:
        """Whether it was started and has not ended."""
        return self.state is ProcessState.RUNNING

    def wait(self, timeout: float | None = None) -> int | None:
        """Block until it has ended, at most `timeout` s of its clock's time; its exit code, None while it runs."""
        deadline = None if timeout is None else self.clock.steady_ns() + int(timeout * 1e9)
        self._ended.wait(deadline)
        return self.exit_code

    def interrupt(self) -> None:
        """SIGINT: hooks, then `KeyboardInterrupt` (or its own handler) in its main thread, woken from any wait."""
        self.send_signal(signal.SIGINT)

    def terminate(self) -> None:
        """SIGTERM: hooks or its own handler; where there is neither it ends with -15."""
        self.send_signal(signal.SIGTERM)

    def deliver_signals(self) -> None:
        """Let signals that are on their way take effect first, where the caller is its main thread.

        For code that has seen the effect of a hook: a real process would by now run the handler.
        """
        state = local.state
        if state is None or state is not self.main_state:
            return
        # A stepped run has one thread at work, so nothing can be on its way; waiting would keep the baton.
        while self.signals.sending and not self.clock.stepped:
            real.sleep(0.0005)
        state.deliver()

    def kill(self) -> None:
        """SIGKILL: it ends now with -9; code of it that does not unwind is abandoned, and a notice names the line."""
        self.send_signal(SIGKILL)

    def send_signal(self, signum: int) -> None:
        """Deliver a signal by number; without effect once it has ended."""
        if self.is_alive:
            self.signals.send(int(signum))

    def stop(self, grace: float = 5.0) -> int:
        """Interrupt, terminate, kill, with `grace` s of its clock's time between; its exit code."""
        for signum in (signal.SIGINT, signal.SIGTERM):
            self.send_signal(signum)
            if self.wait(grace) is not None:
                break
        self.kill()
        return self.exit_code if self.exit_code is not None else -SIGKILL

    def on_interrupt(
        self, callback: Callable[[int], Any], signals: Iterable[int] = (signal.SIGINT, signal.SIGTERM)
    ) -> Callable[[], None]:
        """Call `callback(signum)` first when one of the signals comes, in the sender's thread with this `current()`.

        A hook for SIGTERM counts as its handler: the process goes on. Returns what takes the hook away.
        """
        return self.signals.add_hook(callback, (int(signum) for signum in signals))

    def on_exit(self, callback: Callable[[NodeProcess], Any]) -> Callable[[], None]:
        """Call `callback(process)` once when it has ended, however; newest first. At once where it has ended already.

        Returns what takes the callback away.
        """
        with self._exit_lock:
            if self.exit_code is None:
                self._exit_callbacks.append(callback)
                return partial(_discard, self._exit_callbacks, callback)
        callback(self)
        return lambda: None

    def end_with_main(self, pool: Pool) -> None:
        """Once the main program is over, let a pool do what was submitted to it and end, and wait for that."""
        self.pools.add(pool)

    def on_abandon(self, callback: Callable[[], Any]) -> Callable[[], None]:
        """Call `callback()` once it is over, however: leave the graph, because code of it may still be running.

        At once where it is over: a killed thread may come this far.

        All these come before the first `on_exit`. Returns what takes the callback away.
        """
        with self._exit_lock:
            over = self.exit_code is not None
            if not over:
                self._abandon_callbacks.append(callback)
        if over:
            callback()
        return partial(_discard, self._abandon_callbacks, callback)

    def line(self) -> str | None:
        """Where its main thread is, as `file.py:12, in function`; None when it has ended."""
        return None if self.main_state is None else frames.thread_line(self.main_state.ident)

    def thread_states(self) -> list[NodeThread]:
        """Its main thread and the threads that it started, those that have ended excepted."""
        main = [] if self.main_state is None else [self.main_state]
        return [state for state in (*main, *self.children.values()) if state.thread.is_alive()]

    def cpu_seconds(self) -> float | None:
        """Processor time (s) that its threads have used; None where the system does not tell."""
        from ..watch.processor_time import total_seconds

        running = total_seconds(self.thread_states())
        return None if running is None else self.cpu_of_ended_threads + running

    def guarded(self, callback: Callable[[], Any]) -> None:
        """Call back; an exception becomes a notice, because whoever ends or signals a process must get on."""
        try:
            callback()
        except Exception as exception:
            notify(self, f"a callback at the end of the process failed: {exception!r}")

    def die(self, code: int) -> None:
        """End now with this exit code, without last words; raises `ProcessKilled` in all of its threads."""
        if not self.is_alive:
            return
        states = self.thread_states()
        for capture in (self.stdout, self.stderr):
            if capture is not None:
                # Before the exit is told: a killed process says nothing after that.
                capture.mute()
        self.finish(code)
        for state in states:
            state.kill()
        self.break_off_later(states)
        if local.state in states:
            raise ProcessKilled

    def break_off_later(self, states: Sequence[NodeThread]) -> None:
        """Give killed threads a moment to unwind; then raise in those that compute, then say which one hangs where."""
        real.later(KILL_GRACE_S, partial(self._break_off, states))

    def _break_off(self, states: Sequence[NodeThread]) -> None:
        left = [state for state in states if state.thread.is_alive()]
        # One that waits for its turn raises by itself when that comes; thrown at, it would break the order.
        if any(state.takes_turns for state in left):
            self.break_off_later(left)
            return
        for state in left:
            state.throw(ProcessKilled)
        if left:
            real.later(KILL_GRACE_S, partial(self._report_hanging, left))

    def _report_hanging(self, states: Sequence[NodeThread]) -> None:
        for state in states:
            if state.thread.is_alive() and not state.waiting:
                self.state = ProcessState.ABANDONED
                line = frames.thread_line(state.ident)
                notify(self, f"did not end when it was told to, so it is abandoned. It hangs in {line}")

    def finish(self, code: int) -> None:
        """Record the end of the process, once, and tell everyone."""
        with self._exit_lock:
            if self.exit_code is not None:
                return
            self.exit_code = code
        self.state = ProcessState.EXITED
        running.pop(self.pid, None)
        # Whoever ends it, the callbacks find out for whom they are called by `current()`.
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
