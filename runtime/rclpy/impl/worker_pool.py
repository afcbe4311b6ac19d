"""A pool of threads for callbacks. Their waits use the clock source, so that stepped runs work."""

from __future__ import annotations

import os
import threading
import weakref
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import ProcessKilled, current

if TYPE_CHECKING:
    from bot_console.runtime.process.clock_source import Wakeup


class WorkerPool:
    """Up to `size` threads, each started when it is first needed."""

    def __init__(self, size: int, name: str) -> None:
        self._size = size
        self._name = name
        self._clock = current().clock
        self._work: deque[Callable[[], object]] = deque()
        self._idle: deque[Wakeup] = deque()
        self._lock = threading.Lock()
        self._threads = 0
        self._serving: set[int] = set()
        """The threads that have not ended."""
        self._waiting: list[Any] = []
        """Wakeups of the threads that wait for the pool's threads to end."""
        self._closed = False
        current().end_with_main(self)

    def submit(self, work: Callable[[], object]) -> None:
        """Run `work()` in one of the threads; it must not raise. After `shutdown` the call has no effect."""
        with self._lock:
            if self._closed:
                return
            self._work.append(work)
            if self._idle:
                self._idle.popleft().set()
            elif self._threads < self._size:
                self._threads += 1
                name = f"{self._name}-{self._threads}"
                # Not a daemon: as upstream, a callback that has begun runs to its end even if the program has ended.
                thread = threading.Thread(target=self._run, name=name, daemon=False)
                thread.start()
                self._serving.add(thread.ident or 0)

    def _run(self) -> None:
        try:
            self._serve()
        finally:
            with self._lock:
                self._serving.discard(threading.get_ident())
                for each in self._waiting:
                    each.set()

    def _serve(self) -> None:
        wakeup = self._clock.wakeup()
        while True:
            with self._lock:
                work = self._work.popleft() if self._work else None
                if work is None:
                    if self._closed:
                        return
                    # With the lock held, so that work submitted from now on finds this thread idle.
                    wakeup.clear()
                    self._idle.append(wakeup)
            if work is None:
                wakeup.wait()
            else:
                try:
                    work()
                except ProcessKilled:
                    raise
                except BaseException:  # as in upstream's pool, SystemExit and the like end only the callback
                    continue

    def shutdown(self, wait: bool = False) -> None:
        """Let the threads end once they have no work left; with `wait`, wait for all of them but the calling one."""
        ended = self._clock.wakeup() if wait else None
        with self._lock:
            self._closed = True
            while self._idle:
                self._idle.popleft().set()
            if ended is not None:
                self._waiting.append(ended)
        while ended is not None and self._is_serving(ended):
            ended.wait()

    def _is_serving(self, ended: Any) -> bool:
        with self._lock:
            ended.clear()
            return bool(self._serving - {threading.get_ident()})


def report_unfetched_at_exit(owner: object, futures: deque[Any]) -> None:
    """Print, as upstream does at the program's end, the exceptions that were never retrieved."""
    weakref.finalize(owner, _report_unfetched, futures)


def _report_unfetched(futures: deque[Any]) -> None:
    while futures:
        futures.popleft().report_unfetched()


def cpu_count() -> int:
    """Return the number of CPUs this process may use; 2 if the operating system does not tell."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return 2
