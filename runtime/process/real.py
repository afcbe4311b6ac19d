"""The real clock and real threads, whatever else is wrapped: for the runtime's own helpers."""

from __future__ import annotations

import _thread
import threading
import time
from collections.abc import Callable

sleep = time.sleep
monotonic = time.monotonic
start_thread = threading.Thread.start
join_thread = threading.Thread.join
is_thread_alive = threading.Thread.is_alive
main_thread = threading.main_thread
enumerate_threads = threading.enumerate


def later(seconds: float, action: Callable[[], None]) -> None:
    """Call `action` after that much wall time (s), in a thread of its own that belongs to no node process."""

    def run() -> None:
        sleep(seconds)
        action()

    _thread.start_new_thread(run, ())
