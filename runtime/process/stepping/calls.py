"""Calls wrapped during stepped runs: the `time` module returns virtual time, and new locks belong to the run."""

from __future__ import annotations

import os
import queue
import threading
import time
from collections.abc import Callable
from typing import Any

from ..clock_source import ClockSource
from ..node.thread_state import local
from . import lock as stepped_lock
from . import one_cpu


def _stepped_clock() -> ClockSource | None:
    clock = local.waits_on
    return clock if clock is not None and clock.stepped else None


def _reading(name: str, read: Callable[[ClockSource], int]) -> tuple[Callable[[], float], Callable[[], int]]:
    """Return the wrappers of `time.<name>` (s) and `time.<name>_ns`."""
    real_s, real_ns = getattr(time, name), getattr(time, f"{name}_ns")

    def seconds() -> float:
        clock = _stepped_clock()
        return real_s() if clock is None else read(clock) * 1e-9

    def nanoseconds() -> int:
        clock = _stepped_clock()
        return real_ns() if clock is None else read(clock)

    return seconds, nanoseconds


def _broken_down(name: str) -> Callable[..., Any]:
    """Return the wrapper of `time.localtime` or a similar function, which defaults to the virtual time."""
    real_call = getattr(time, name)

    def wrapped(seconds: float | None = None, /) -> Any:
        clock = _stepped_clock()
        return real_call(clock.system_ns() * 1e-9 if clock is not None and seconds is None else seconds)

    return wrapped


def _wraps() -> list[tuple[Any, str, Any]]:
    system = _reading("time", lambda clock: clock.system_ns())
    steady = _reading("monotonic", lambda clock: clock.steady_ns())
    precise = _reading("perf_counter", lambda clock: clock.steady_ns())
    wraps: list[tuple[Any, str, Any]] = [
        (time, "time", system[0]),
        (time, "time_ns", system[1]),
        (time, "monotonic", steady[0]),
        (time, "monotonic_ns", steady[1]),
        (time, "perf_counter", precise[0]),
        (time, "perf_counter_ns", precise[1]),
        (threading, "Lock", stepped_lock.Lock),
        (threading, "RLock", stepped_lock.RLock),
        (os, "sched_getaffinity", one_cpu.sched_getaffinity),
        (threading, "_time", steady[0]),
        (queue, "time", steady[0]),
    ]
    wraps += [(time, name, _broken_down(name)) for name in ("localtime", "gmtime", "ctime")]
    return [(owner, name, wrap) for owner, name, wrap in wraps if hasattr(owner, name)]


_undo: list[tuple[Any, str, Any]] = []
_users = 0
_guard = threading.Lock()


def install_stepped_calls() -> None:
    """Wrap these calls, until `uninstall_stepped_calls` was called as often as this function."""
    global _users
    with _guard:
        _users += 1
        if _users == 1:
            for owner, name, wrap in _wraps():
                _undo.append((owner, name, getattr(owner, name)))
                setattr(owner, name, wrap)


def uninstall_stepped_calls() -> None:
    """Restore the calls when no stepped run needs them any more."""
    global _users
    with _guard:
        _users -= 1
        while _undo and not _users:
            setattr(*_undo.pop())
