"""The real process in the role of a node process: nothing in it is virtual."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from ..real_time import RealTime
from .node_process import NodeProcess

if TYPE_CHECKING:
    from ..roles import Pool


class MainProcess(NodeProcess):
    """The process of all threads that no node process has started; its signals are real."""

    def __init__(self, name: str) -> None:
        super().__init__(name, RealTime())
        self.pid = os.getpid()
        self.argv = sys.argv
        self.env = os.environ
        self._replaced: dict[int, Any] = {}
        self._ends_pools = False

    @property
    def is_alive(self) -> bool:
        """Always True: this code runs in it."""
        return True

    def on_interrupt(
        self, callback: Callable[[int], Any], signals: Iterable[int] = (signal.SIGINT, signal.SIGTERM)
    ) -> Callable[[], None]:
        """Call `callback(signum)` when the real process gets the signal, then the previous handler.

        Takes effect only from the main thread, where Python allows signal handlers. Returns a function that removes the
        hook.
        """
        wanted = frozenset(int(signum) for signum in signals)
        remove = self.signals.add_hook(callback, wanted)
        if threading.current_thread() is threading.main_thread():
            for signum in wanted - self._replaced.keys():
                self._replaced[signum] = signal.signal(signum, self._handle)
        return partial(self._unhook, remove)

    def _unhook(self, remove: Callable[[], None]) -> None:
        remove()
        if self.signals.hooked or threading.current_thread() is not threading.main_thread():
            return
        for signum, before in self._replaced.items():
            if signal.getsignal(signum) == self._handle:
                signal.signal(signum, before if before is not None else signal.SIG_DFL)
        self._replaced.clear()

    def _handle(self, signum: int, frame: Any) -> None:
        self.signals.run_hooks(signum)
        before = self._replaced.get(signum)
        if callable(before):
            before(signum, frame)

    def end_with_main(self, pool: Pool) -> None:
        """Shut a pool down after the main program, before the interpreter waits for threads, as for its own pools."""
        super().end_with_main(pool)
        if not self._ends_pools:
            self._ends_pools = True
            with suppress(RuntimeError):  # the main program has ended, and a thread creates this pool
                threading._register_atexit(self._end_pools)  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType] -- as `concurrent.futures`

    def _end_pools(self) -> None:
        for pool in list(self.pools):
            pool.shutdown(wait=False)

    def send_signal(self, signum: int) -> None:
        """Send the real process a real signal."""
        if hasattr(signal, "pthread_kill"):
            signal.pthread_kill(threading.main_thread().ident or 0, signum)  # where Python runs signal handlers
        else:
            os.kill(os.getpid(), signum)

    def die(self, code: int) -> None:
        """Do nothing: a run never ends the real process."""

    def start(self, *_arguments: Any, **_options: Any) -> None:
        """Raise `RuntimeError`: the process is already running."""
        raise RuntimeError("the real process is already running")
