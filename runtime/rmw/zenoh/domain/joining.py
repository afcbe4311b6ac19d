"""Let processes join a domain one at a time: two that list the folder at the same time would miss each other."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Generator

from bot_console.runtime.process.watch.processor_time import state_and_seconds
from bot_console.runtime.rmw.zenoh.domain.file_lock import FOLDER_HOLDS_LOCKS, open_lock, try_lock
from bot_console.runtime.rmw.zenoh.domain.sockets import is_stopped, live_sockets

LOCK_TIMEOUT_S = 0.2
"""Timeout of one attempt to get the lock, in s; after each attempt the lock's holder is checked."""

MAX_HOLD_S = 2.0
"""Time without processor use, in s, after which a holder of the lock is considered hung."""

MAX_WAIT_S = 10.0
"""How long, in s, one process may hold the lock, or no holder be found, before a process continues without the lock.
Joining takes 10 ms, and several times that on a busy machine.
"""

POLL, MAX_POLL_S = 0.003, 0.02
"""Interval between attempts to get the lock, in s, at first and at most: fifty waiting processes would otherwise take
the processor from the holder.
"""


@contextlib.contextmanager
def folder_lock(folder: str) -> Generator[None]:
    """Hold the lock of a domain's folder.

    A process that freezes or hangs while it holds the lock blocks nobody: the others continue without the lock, and the
    watch that each process keeps on the folder restores the links they missed.
    """
    handle = _open_lock(folder)
    try:
        behind = _LockHolder()
        while not _acquire(handle, LOCK_TIMEOUT_S) and not behind.hangs(_holder(handle)):
            pass
        yield
    finally:
        os.close(handle)


class _LockHolder:
    """Tracks who holds the lock, since when, and since when that process has used no processor time."""

    def __init__(self) -> None:
        self._holder: int | None = None
        self._used = 0.0
        self._since = self._idle_since = time.monotonic()

    def hangs(self, holder: int | None) -> bool:
        """Whether the current holder will not release the lock; `holder` is None if there is none or it is unknown."""
        now, used = time.monotonic(), _time_used(holder)
        if holder != self._holder:
            self._since = now
        if (holder, used) != (self._holder, self._used):
            self._idle_since = now
        self._holder, self._used = holder, used
        if holder is not None and (is_stopped(holder) or now - self._idle_since >= MAX_HOLD_S):
            return True
        return now - self._since >= MAX_WAIT_S


def remove_dead(folder: str) -> None:
    """Remove dead sockets from a domain's folder, unless a process is joining, which removes them as well."""
    with contextlib.suppress(OSError):
        handle = _open_lock(folder)
        try:
            if _acquire(handle, 0.0):
                live_sockets(folder)
        finally:
            os.close(handle)


def _open_lock(folder: str) -> int:
    """Open what is to be locked: the folder itself if possible, as a lock file could be removed while it is locked."""
    if FOLDER_HOLDS_LOCKS:
        return os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    return open_lock(os.path.join(folder, "joining.lock"))


def _acquire(handle: int, timeout_s: float) -> bool:
    """Try to get the lock for up to `timeout_s`; return whether it was acquired."""
    deadline, pause = time.monotonic() + timeout_s, POLL
    while True:
        if try_lock(handle):
            return True
        if time.monotonic() >= deadline:
            return False
        time.sleep(pause)
        pause = min(pause * 1.3, MAX_POLL_S)


def _time_used(pid: int | None) -> float:
    """Return the processor time (s) that a process has used; 0 if unknown."""
    reported = state_and_seconds(str(pid))
    return reported[1] if reported else 0.0


def _holder(handle: int) -> int | None:
    """Return the process that holds the lock; None if nobody holds it any more or the system does not tell."""
    inode = f":{os.fstat(handle).st_ino}"
    try:
        with open("/proc/locks") as file:
            rows = [line.split() for line in file]
    except OSError:
        return None
    return next((int(row[4]) for row in rows if row[1] == "FLOCK" and row[5].endswith(inode)), None)
