"""One at a time joins a domain: without that, two that start together would list the folder and never meet."""

from __future__ import annotations

import contextlib
import fcntl
import os
import time
from collections.abc import Generator

from bot_console.runtime.rmw.zenoh.domain.sockets import is_stopped, live_sockets

PATIENCE = 0.2
"""How long one try for the lock lasts, in s; then it is looked at who holds it."""

LONGEST_HOLD = 2.0
"""After this time, in s, one that holds the lock is taken to hang in it: to join takes 10 ms, and some times that on a
busy machine."""

LONGEST_WAIT = 10.0
"""After this time, in s, a process goes on without the lock where the system does not tell who holds it."""


@contextlib.contextmanager
def folder_lock(folder: str) -> Generator[None]:
    """Hold the lock of a domain's folder.

    A process that is frozen or hangs while it holds the lock stops nobody: the others go on without, and what they miss
    of each other is mended by the watch that each of them keeps on the folder.
    """
    # The folder itself is locked: a lock file could be removed while somebody holds it.
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        deadline = time.monotonic() + LONGEST_WAIT
        held_by, since = None, time.monotonic()
        while not _taken(handle, PATIENCE):
            holder, now = _holder(handle), time.monotonic()
            if holder != held_by:
                held_by, since = holder, now
            if (is_stopped(holder) or now - since >= LONGEST_HOLD) if holder else now > deadline:
                break
        yield
    finally:
        os.close(handle)


def remove_dead(folder: str) -> None:
    """Take the sockets of the dead out of a domain's folder, unless somebody joins just then, who does it as well."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        try:
            if _taken(handle, 0.0):
                live_sockets(folder)
        finally:
            os.close(handle)


def _taken(handle: int, patience: float) -> bool:
    """Whether the lock was got in this time (s)."""
    deadline = time.monotonic() + patience
    while True:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        except BlockingIOError:
            if time.monotonic() >= deadline:
                return False
        time.sleep(0.003)


def _holder(handle: int) -> int | None:
    """The process that holds the lock; None where the system does not tell."""
    inode = f":{os.fstat(handle).st_ino}"
    try:
        with open("/proc/locks") as file:
            rows = [line.split() for line in file]
    except OSError:
        return None
    return next((int(row[4]) for row in rows if row[1] == "FLOCK" and row[5].endswith(inode)), None)
