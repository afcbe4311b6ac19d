"""Processes join a domain one at a time: otherwise two that start together would list the folder and never meet."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Generator

from bot_console.runtime.rmw.zenoh.domain.file_lock import FOLDER_HOLDS_LOCKS, NO_LINK, try_lock
from bot_console.runtime.rmw.zenoh.domain.sockets import is_stopped, live_sockets

PATIENCE = 0.2
"""How long one try for the lock lasts, in s; then it is looked at who holds it."""

LONGEST_HOLD = 2.0
"""After this time, in s, one that holds the lock and has had no processor time is taken to hang in it."""

LONGEST_WAIT = 10.0
"""After this time, in s, behind the same process, or while no process is seen to hold the lock, one goes on without it:
to join takes 10 ms, and some times that on a busy machine.
"""

POLL, LONGEST_POLL = 0.003, 0.02
"""How soon the lock is tried again, in s, at first and in the end: fifty that wait would else keep one who has it from
the processor.
"""


@contextlib.contextmanager
def folder_lock(folder: str) -> Generator[None]:
    """Hold the lock of a domain's folder.

    A process that is frozen or hangs while it holds the lock stops nobody: the others go on without, and what they miss
    of each other is mended by the watch that each of them keeps on the folder.
    """
    handle = _opened(folder)
    try:
        behind = _Behind()
        while not _taken(handle, PATIENCE) and not behind.hangs(_holder(handle)):
            pass
        yield
    finally:
        os.close(handle)


class _Behind:
    """Who holds the lock, and since when it has been the same one."""

    def __init__(self) -> None:
        self._holder: int | None = None
        self._used = 0
        self._since = self._idle_since = time.monotonic()

    def hangs(self, holder: int | None) -> bool:
        """Whether the one that holds the lock now does not give it back; None where that is nobody, or not told."""
        now, used = time.monotonic(), _time_used(holder)
        if holder != self._holder:
            self._since = now
        if (holder, used) != (self._holder, self._used):
            self._idle_since = now
        self._holder, self._used = holder, used
        if holder is not None and (is_stopped(holder) or now - self._idle_since >= LONGEST_HOLD):
            return True
        return now - self._since >= LONGEST_WAIT


def remove_dead(folder: str) -> None:
    """Take the sockets of the dead out of a domain's folder, unless somebody joins just then, who does it as well."""
    with contextlib.suppress(OSError):
        handle = _opened(folder)
        try:
            if _taken(handle, 0.0):
                live_sockets(folder)
        finally:
            os.close(handle)


def _opened(folder: str) -> int:
    """What is locked: the folder itself where it can be, as a lock file could be removed while somebody holds it."""
    if FOLDER_HOLDS_LOCKS:
        return os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    return os.open(os.path.join(folder, "joining.lock"), os.O_RDWR | os.O_CREAT | NO_LINK, 0o600)


def _taken(handle: int, patience: float) -> bool:
    """Whether the lock was got in this time (s)."""
    deadline, pause = time.monotonic() + patience, POLL
    while True:
        if try_lock(handle):
            return True
        if time.monotonic() >= deadline:
            return False
        time.sleep(pause)
        pause = min(pause * 1.3, LONGEST_POLL)


def _time_used(pid: int | None) -> int:
    """The processor time that a process has had, in ticks of the system; 0 where that is not told."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            fields = file.read().rpartition(b")")[2].split()
        return int(fields[11]) + int(fields[12])
    except (OSError, IndexError, ValueError):
        return 0


def _holder(handle: int) -> int | None:
    """The process that holds the lock; None where nobody does any more, or the system does not tell."""
    inode = f":{os.fstat(handle).st_ino}"
    try:
        with open("/proc/locks") as file:
            rows = [line.split() for line in file]
    except OSError:
        return None
    return next((int(row[4]) for row in rows if row[1] == "FLOCK" and row[5].endswith(inode)), None)
