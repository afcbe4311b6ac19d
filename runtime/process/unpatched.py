"""The real clock, process id and threads, even where they are wrapped; for the runtime's own helpers."""

from __future__ import annotations

import _thread
import atexit
import os
import threading
import time
from collections.abc import Callable
from heapq import heappop, heappush

getpid = os.getpid
at_exit = atexit.register
sleep = time.sleep
monotonic = time.monotonic
start_thread = threading.Thread.start
join_thread = threading.Thread.join
is_thread_alive = threading.Thread.is_alive
main_thread = threading.main_thread
enumerate_threads = threading.enumerate


class _WallTimeSchedule:
    """Actions scheduled in wall time, run by a thread that exists only while there are any."""

    def __init__(self) -> None:
        # Built-in locks and threads: those of `threading` belong to node processes and to stepped runs.
        self._guard = _thread.allocate_lock()
        self._news = _thread.allocate_lock()
        # A lock used as an event: held while there is nothing new.
        self._news.acquire()
        self._entries: list[tuple[float, int, Callable[[], None]]] = []
        self._count = 0
        self._running = False

    def add(self, due: float, action: Callable[[], None]) -> None:
        with self._guard:
            self._count += 1
            heappush(self._entries, (due, self._count, action))
            if not self._running:
                self._running = True
                _thread.start_new_thread(self._run, ())
            elif self._news.locked():
                self._news.release()

    def _run(self) -> None:
        while (due := self._next_due()) is not None:
            if (remaining := due - monotonic()) > 0:
                self._news.acquire(True, remaining)
                continue
            with self._guard:
                action = heappop(self._entries)[2]
            action()

    def _next_due(self) -> float | None:
        with self._guard:
            self._running = bool(self._entries)
            return self._entries[0][0] if self._entries else None


_agenda = _WallTimeSchedule()


def later(seconds: float, action: Callable[[], None]) -> None:
    """Call `action`, which must not block, after `seconds` of wall time, in a thread of no node process."""
    _agenda.add(monotonic() + seconds, action)
