"""Keeps a stepped run on one processor: its threads only take turns, and a turn passes 2 to 3 times faster there.

Twice as fast again where the system lets a thread that wakes another one go on to its own wait: the woken one would
else interrupt it, find the interpreter taken, and sleep again.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable

BLAS_THREADS = "OPENBLAS_NUM_THREADS"
_real: Callable[[int], set[int]] = getattr(os, "sched_getaffinity", lambda _pid: {0})
_processors: list[set[int]] = []


def pin_thread() -> Callable[[], None]:
    """Pin the calling thread, and the threads that it will start, to one processor where none interrupts another.

    Returns what undoes it. Without effect where the system does not offer it (only Linux does).
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
    """Make the calling thread one that interrupts no other when it is woken; returns what undoes it."""
    if os.sched_getscheduler(0) != os.SCHED_OTHER:  # somebody has chosen another policy
        return lambda: None
    try:
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
    except OSError:  # not allowed in this container
        return lambda: None
    return lambda: os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


def import_numpy() -> None:
    """Import `numpy`, with its random numbers, without the threads that its linear algebra has for other processors.

    Each of them turns round for 30 to 100 ms before it sleeps for the first time, beside the imports that follow: a
    third of what the start of a run takes. A number of threads that is asked for in the environment is kept.
    """
    asked = os.environ.get(BLAS_THREADS)
    os.environ.setdefault(BLAS_THREADS, "1")
    try:
        importlib.import_module("numpy.random")
    finally:
        if asked is None:  # programs that a node starts have the environment that was given
            os.environ.pop(BLAS_THREADS, None)


def sched_getaffinity(pid: int, /) -> set[int]:
    """`os.sched_getaffinity`: what a node would have without the pin, because it sizes its thread pools by that."""
    return set(_processors[-1]) if _processors and pid == 0 else _real(pid)
