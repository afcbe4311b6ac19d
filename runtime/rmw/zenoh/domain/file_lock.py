"""A lock on an open file that is released when its process ends, however it ends."""

from __future__ import annotations

import os

FOLDER_HOLDS_LOCKS = hasattr(os, "O_DIRECTORY")
"""Whether a folder can be opened, and can therefore be locked itself."""

NO_LINK = getattr(os, "O_NOFOLLOW", 0)
"""Flag that refuses to open a symbolic link; 0 if the system has no such flag."""


def open_lock(path: str | os.PathLike[str]) -> int:
    """Open a file for locking, created for this user alone if missing; follows no symbolic links. Raises `OSError`."""
    return os.open(path, os.O_RDWR | os.O_CREAT | NO_LINK, 0o600)


def try_lock(handle: int) -> bool:
    """Lock an open file until it is closed; return False if another process holds the lock.

    Raises `OSError` if the file cannot be locked at all.
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
