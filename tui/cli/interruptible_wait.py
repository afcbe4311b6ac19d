"""Waiting in a main thread for which signals end the program."""

from __future__ import annotations

import threading
import time

SLICE = 0.5
"""Seconds after which the main thread looks whether a signal has come."""


def wait_interruptibly(event: threading.Event, seconds: float | None = None) -> bool:
    """Wait for an event as its `wait` does, and run the handlers of signals meanwhile, whoever has got them.

    A signal that comes while the process is frozen (SIGSTOP, Ctrl-Z) is handed to any of its threads when it goes on.
    Only the main thread runs Python's handlers, and one that waits for a lock is woken by its own signals alone.
    """
    deadline = None if seconds is None else time.monotonic() + seconds
    while True:
        left = SLICE if deadline is None else deadline - time.monotonic()
        if event.wait(max(0.0, min(SLICE, left))):
            return True
        if left <= SLICE and deadline is not None:
            return False
