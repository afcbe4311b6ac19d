"""Signals of a node process: what SIGINT, SIGTERM and others do to a thread that looks like a process."""

from __future__ import annotations

import _thread
import signal
import sys
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, Any

from .. import unpatched
from ..notices import notify
from .thread_state import local

if TYPE_CHECKING:
    from ..roles import CurrentProcess, Handler, NodeThread

BUSY_TIMEOUT_S = 0.1
"""How long (s) a busy thread may take to reach a wait before the exception is raised at any point of it."""

SIGKILL = 9
_IGNORED_BY_DEFAULT = frozenset(
    getattr(signal, name) for name in ("SIGCHLD", "SIGURG", "SIGWINCH", "SIGCONT") if hasattr(signal, name)
)
_JOB_CONTROL = frozenset(
    getattr(signal, name) for name in ("SIGSTOP", "SIGTSTP", "SIGTTIN", "SIGTTOU") if hasattr(signal, name)
)
Hook = Callable[[int], Any]


class Signals:
    """One node process's response to each signal: hooks such as rclpy's, and the handler set by `signal.signal`."""

    def __init__(self, process: CurrentProcess) -> None:
        self._process = process
        self._hooks: list[tuple[Hook, frozenset[int]]] = []
        self._handlers: dict[int, Handler] = {signal.SIGINT: signal.default_int_handler}
        self.sending = 0
        """Number of signals between their hooks and their handler."""

    def add_hook(self, hook: Hook, signals: Iterable[int]) -> Callable[[], None]:
        """Call `hook(signum)` before the handler, like a handler that calls the one it replaced."""
        entry = (hook, frozenset(signals))
        self._hooks.append(entry)
        return partial(self._remove_hook, entry)

    def _remove_hook(self, entry: tuple[Hook, frozenset[int]]) -> None:
        if entry in self._hooks:
            self._hooks.remove(entry)

    def handler(self, signum: int) -> Handler:
        """Return the handler, as `signal.getsignal` does."""
        return self._handlers.get(signum, signal.SIG_DFL)

    def set_handler(self, signum: int, handler: Handler) -> Handler:
        """Set the handler, as `signal.signal` does: earlier hooks are removed, as an earlier `sigaction` would be."""
        before = self.handler(signum)
        self._hooks = [(hook, signals - {signum}) for hook, signals in self._hooks]
        self._handlers[signum] = handler
        return before

    def send(self, signum: int) -> None:
        """Deliver a signal: hooks first, in the calling thread, then the handler in the process's main thread."""
        if signum == SIGKILL:
            self._process.die(-SIGKILL)
            return
        if signum in _JOB_CONTROL:
            notify(self._process, f"signal {signum} asks the process to pause, which a node in a thread cannot")
            return
        self.sending += 1
        try:
            hooked = self.run_hooks(signum)
            handler = self.handler(signum)
            if callable(handler):
                self._run_in_main_thread(signum, handler)
        finally:
            self.sending -= 1
        if callable(handler):
            return
        if handler != signal.SIG_IGN and not hooked and signum not in _IGNORED_BY_DEFAULT:
            self._process.die(-int(signum))

    @property
    def hooked(self) -> bool:
        """Whether any hook is registered."""
        return bool(self._hooks)

    def run_hooks(self, signum: int) -> bool:
        """Call the hooks of a signal as this process; return whether there were any."""
        hooks = [hook for hook, signals in self._hooks if signum in signals]
        # The sender is another thread, often one of another process.
        before, local.process = local.process, self._process
        try:
            for hook in hooks:
                self._process.guarded(partial(hook, signum))
        finally:
            local.process = before
        return bool(hooks)

    def _run_in_main_thread(self, signum: int, handler: Callable[[int, Any], Any]) -> None:
        state = self._process.main_state
        if state is None:
            return
        action = partial(self._call_handler, handler, signum)
        state.post(action)
        if state is local.state:
            state.deliver()
        elif not state.waiting:
            unpatched.later(BUSY_TIMEOUT_S, partial(self._break_in, state, action))

    def _call_handler(self, handler: Callable[[int, Any], Any], signum: int) -> None:
        handler(signum, sys._getframe())  # pyright: ignore[reportPrivateUsage] -- documented in `sys`

    def _break_in(self, state: NodeThread, action: partial[Any]) -> None:
        """Interrupt a busy thread: run the handler elsewhere and raise in the thread what the handler raises."""
        if state.takes_turns:
            if state.called and state.thread.is_alive():
                unpatched.later(BUSY_TIMEOUT_S, partial(self._break_in, state, action))
        elif state.take_back(action):
            # The busy thread cannot be made to call the handler, so it is called in a new thread.
            _thread.start_new_thread(self._handle_for, (state, action))

    def _handle_for(self, state: NodeThread, action: partial[Any]) -> None:
        local.process = self._process
        try:
            action()
        except BaseException as exception:  # a handler may raise anything, SystemExit included
            state.throw(_as_class(exception))


def _as_class(exception: BaseException) -> type[BaseException]:
    """Return a class that creates the same exception: the interpreter raises only classes in another thread."""
    if not exception.args:
        return type(exception)

    def again(self: BaseException) -> None:
        kind.__init__(self, *exception.args)

    kind = type(exception)
    return type(kind.__name__, (kind,), {"__init__": again, "__module__": kind.__module__})
