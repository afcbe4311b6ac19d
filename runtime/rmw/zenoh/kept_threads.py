"""Keeps the interpreter's state for a Zenoh thread that calls back, instead of recreating it for each call."""

from __future__ import annotations

import itertools
import sys
import threading

ENOUGH = 200
"""Callbacks from which on keeping is worth the import of `ctypes`, where the program has none of it yet: 2.5 ms."""

MOST = 64
"""Threads that are kept at most: Zenoh has some ten, and one that ended would leave its state behind."""


class _Here(threading.local):
    """What is known in each thread."""

    kept = False


here = _Here()
"""`kept` says whether the thread that asks keeps its state; that goes with the state."""
_calls = itertools.count(1)
_kept = itertools.count(1)


def keep() -> None:
    """Let the calling thread, one of Zenoh's in a callback, keep its state until the process ends.

    A thread that Python did not start gets a state of the interpreter, with pages mapped for its frames, when it calls
    back and loses it when it returns: that is most of what receiving a short message costs (9 of 10 us). One more hold
    on the state, never given back, makes it stay. Zenoh has few such threads, and they live as long as the process.
    """
    if (next(_calls) >= ENOUGH or "ctypes" in sys.modules) and next(_kept) <= MOST:
        import ctypes

        ctypes.pythonapi.PyGILState_Ensure()
        here.kept = True
