"""Lets a main thread wait in such a way that signals are handled meanwhile."""

from __future__ import annotations

import threading
import time

WAIT_SLICE_S = 0.5
"""Seconds after which the main thread checks whether a signal has arrived."""


def wait_interruptibly(event: threading.Event, seconds: float | None = None) -> bool:
    """Wait for an event like `Event.wait`, and run signal handlers meanwhile, whichever thread received the signal.

    A signal that arrives while the process is frozen (SIGSTOP, Ctrl-Z) is delivered to any of its threads when it
    continues. Only the main thread runs Python's handlers, and a thread that waits for a lock is woken only by signals
    delivered to itself.
    """
    deadline = None if seconds is None else time.monotonic() + seconds
    while True:
        left = WAIT_SLICE_S if deadline is None else deadline - time.monotonic()
        if event.wait(max(0.0, min(WAIT_SLICE_S, left))):
            return True
        if left <= WAIT_SLICE_S and deadline is not None:
            return False
