"""Keeps a stepped run on one processor: its threads only take turns, and a turn passes 2 to 3 times faster that way.

It is twice as fast again if the system lets a thread that has woken another one continue to its own wait: otherwise the
woken thread interrupts it, finds the GIL taken, and sleeps again.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable

BLAS_THREADS = "OPENBLAS_NUM_THREADS"
_real: Callable[[int], set[int]] = getattr(os, "sched_getaffinity", lambda _pid: {0})
_processors: list[set[int]] = []


def pin_thread() -> Callable[[], None]:
    """Pin the calling thread, and threads it will start, to one processor where they do not interrupt each other.

    Returns a function that undoes it. Does nothing if the system does not support it (only Linux does).
    """
    if not hasattr(os, "sched_setaffinity"):
        return lambda: None
    before = sched_getaffinity(0)
    try:
        os.sched_setaffinity(0, {sorted(before)[os.getpid() % len(before)]})
    except OSError:  # not allowed in this container
        return lambda: None
    _processors.append(before)
    undo_policy = _let_wakers_go_on()

    def unpin() -> None:
        _processors.remove(before)
        os.sched_setaffinity(0, before)
        undo_policy()

    return unpin


def _let_wakers_go_on() -> Callable[[], None]:
    """Stop the calling thread from interrupting others when it is woken; returns a function that undoes it."""
    if os.sched_getscheduler(0) != os.SCHED_OTHER:  # another policy has been chosen
        return lambda: None
    try:
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
    except OSError:  # not allowed in this container
        return lambda: None
    return lambda: os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


def import_numpy() -> None:
    """Import `numpy` and `numpy.random` without starting BLAS threads for other processors.

    Each of these threads spins for 30 to 100 ms before its first sleep, beside the imports that follow: a third of the
    time that a run takes to start. A number of threads set in the environment is respected.
    """
    asked = os.environ.get(BLAS_THREADS)
    os.environ.setdefault(BLAS_THREADS, "1")
    try:
        importlib.import_module("numpy.random")
    finally:
        if asked is None:  # programs that a node starts get the original environment
            os.environ.pop(BLAS_THREADS, None)


def sched_getaffinity(pid: int, /) -> set[int]:
    """`os.sched_getaffinity`: returns the processors without the pin, because nodes size their thread pools by them."""
    return set(_processors[-1]) if _processors and pid == 0 else _real(pid)
