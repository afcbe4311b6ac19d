"""A lock on an open file that is released when its process ends, however that happens."""

from __future__ import annotations

import os

FOLDER_HOLDS_LOCKS = hasattr(os, "O_DIRECTORY")
"""Whether a folder can be opened, and so be locked itself."""

NO_LINK = getattr(os, "O_NOFOLLOW", 0)
"""Refuses to open a symbolic link, where the system has that."""


def try_lock(handle: int) -> bool:
    """Lock an open file until it is closed; False where another process holds the lock.

    Raises `OSError` where the file cannot be locked at all.
    """
    try:
        import fcntl
    except ImportError:
        return _try_lock_windows(handle)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _try_lock_windows(handle: int) -> bool:
    import msvcrt

    os.lseek(handle, 0, os.SEEK_SET)
    try:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType] -- of Windows
    except PermissionError:
        return False
    return True
