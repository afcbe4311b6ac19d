"""Keeps the interpreter's thread state of a Zenoh thread that calls back, instead of recreating it for each call."""

from __future__ import annotations

import itertools
import sys
import threading

MIN_CALLBACKS = 200
"""Number of callbacks after which keeping the state is worth importing `ctypes` (2.5 ms) if it is not yet imported."""

MAX_THREADS = 64
"""Maximum number of threads that keep their state: Zenoh has about ten, and a thread that ends leaks its state."""


class _CacheFlag(threading.local):
    """Per-thread flag."""

    kept = False


here = _CacheFlag()
"""`kept` is whether the current thread keeps its state; the flag is discarded with that state."""
_calls = itertools.count(1)
_cached = itertools.count(1)


def cache_thread_state() -> None:
    """Make the calling thread, a Zenoh thread in a callback, keep its interpreter state until the process ends.

    A thread not started by Python gets a thread state, with pages mapped for its frames, on each callback and loses it
    on return, which is most of the cost of receiving a short message (9 of 10 us). An additional reference to the
    state, never released, keeps it alive. Zenoh has few such threads, and they live as long as the process.
    """
    if (next(_calls) >= MIN_CALLBACKS or "ctypes" in sys.modules) and next(_cached) <= MAX_THREADS:
        import ctypes

        ctypes.pythonapi.PyGILState_Ensure()
        here.kept = True
