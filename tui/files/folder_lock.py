"""A lock on a folder, for steps that two programs must not take at the same time."""

from __future__ import annotations

import os
import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

POLL_S = 0.02
"""Seconds between two attempts to lock."""


@contextmanager
def folder_lock(folder: Path, timeout_s: float) -> Generator[bool]:
    """Lock a folder during a `with` block; yields whether that succeeded within `timeout_s` seconds.

    The lock leaves no file behind and ends with the program. If folders cannot be locked, every program gets the lock.
    Raises `OSError` for a folder that cannot be opened.
    """
    if os.name != "posix":
        yield True
        return
    import fcntl

    handle = os.open(folder, os.O_RDONLY)
    try:
        deadline = time.monotonic() + timeout_s
        while not (locked := _lock(fcntl, handle)) and time.monotonic() < deadline:
            time.sleep(POLL_S)
        yield locked
    finally:
        os.close(handle)


def _lock(fcntl: Any, handle: int) -> bool:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # the file system does not support locks
        return True
    return True
