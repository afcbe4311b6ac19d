"""Reads the files that the console keeps, without blocking or filling memory if something else has taken their
place.
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path


def read_store(path: Path, maximum: int, *, end: bool = False) -> bytes:
    """Read a file of at most `maximum` bytes; with `end`, the last `maximum` bytes of a larger file.

    Raises `OSError`, in particular `FileNotFoundError` if there is no file. A pipe in its place is refused, since it
    would never end.
    """
    with open(path, "rb", opener=_open_at_once) as file:
        status = os.fstat(file.fileno())
        if not (stat.S_ISREG(status.st_mode) or stat.S_ISCHR(status.st_mode)):  # some users link it to /dev/null
            raise OSError(errno.EINVAL, "it is not a regular file", str(path))
        if end and status.st_size > maximum:
            file.seek(-maximum, os.SEEK_END)
        content = file.read(maximum + 1)
    if len(content) > maximum:
        raise OSError(errno.EFBIG, f"it is larger than {maximum:,} bytes", str(path))
    return content


def _open_at_once(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
