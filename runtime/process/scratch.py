"""A folder for this process's temporary files, removed at its end; those of killed processes are removed by later ones.

A user's programs share one folder with a subfolder per process. Each process keeps its subfolder locked while it lives,
so that the next process to start can recognise leftovers.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import shutil
import stat
import tempfile
from pathlib import Path

from . import unpatched

LOCK = "lock"
OVER = ".over"
"""Suffix of a folder that is being removed: a process that still uses the old name can no longer write into it."""
_made: dict[int, tuple[Path, int]] = {}
_ended: set[int] = set()
"""Contains this process's pid once its folder was removed at its end: nothing would remove a folder made after that."""
_guard = _thread.allocate_lock()
"""For launches that start at once in a process: each would make a folder, and only one would be remembered."""


def _after_fork() -> None:
    global _guard
    _guard = _thread.allocate_lock()  # a thread that does not exist in the child may have held it


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def scratch() -> Path:
    """Return this process's folder; raises `OSError` if it cannot be created, or if the process is ending."""
    pid = unpatched.getpid()
    with _guard:
        if pid in _ended:
            raise OSError("the process is ending")
        if pid not in _made or not _made[pid][0].is_dir():  # some systems clean up /tmp themselves
            _make(pid)
        return _made[pid][0]


def _make(pid: int) -> None:
    base = _base()
    clean(base)
    new = Path(tempfile.mkdtemp(prefix=f".{pid}.", dir=base))
    handle = os.open(new / LOCK, os.O_RDWR | os.O_CREAT, 0o600)
    with contextlib.suppress(OSError):
        _take(handle)
    folder = new.rename(base / new.name[1:])  # only now that it is locked may `clean` see it
    _made.clear()  # entries of the process that forked this one
    _made[pid] = (folder, handle)
    unpatched.at_exit(remove)


def scratch_file(prefix: str, text: str) -> Path:
    """Create a file with this text in the process's folder."""
    handle, path = tempfile.mkstemp(prefix=prefix, dir=scratch())
    with open(handle, "w", encoding="utf-8") as file:
        file.write(text)
    return Path(path)


def remove() -> None:
    """Remove this process's folder at its end; no new one can be created."""
    pid = unpatched.getpid()
    with _guard:
        _ended.add(pid)
        folder, handle = _made.pop(pid, (None, -1))
    if folder is not None:
        with contextlib.suppress(OSError):  # threads of a launch may still be writing
            folder = folder.rename(folder.with_name(folder.name + OVER))
        _delete(folder)
        os.close(handle)


def clean(base: Path) -> None:
    """Remove the folders of processes that no longer exist."""
    for folder in base.glob("[0-9]*.*"):
        with contextlib.suppress(OSError):
            handle = os.open(folder / LOCK, os.O_RDWR)
            try:
                _take(handle)
                _delete(folder)
            finally:
                os.close(handle)


def _delete(folder: Path) -> None:
    """Remove a folder, its lock last: an interrupted removal is completed by the next `clean`."""
    with contextlib.suppress(OSError):
        for each in folder.iterdir():
            if each.is_dir() and not each.is_symlink():
                shutil.rmtree(each, ignore_errors=True)
            elif each.name != LOCK:
                each.unlink()
        (folder / LOCK).unlink()
        folder.rmdir()


def _take(handle: int) -> None:
    """Lock a file while it is open; raises `OSError` if another process holds the lock, or locking is unsupported."""
    try:
        import fcntl
    except ImportError:  # Windows: nothing is removed, as leftovers cannot be recognised
        raise OSError("no file locks here") from None
    fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _base() -> Path:
    """Return a folder closed to other users: normally one beside the sockets, or a private one if that is not ours."""
    user = os.geteuid() if hasattr(os, "geteuid") else 0
    ours = Path(tempfile.gettempdir()) / f"bot-console-{user}"
    for each in (ours, ours / "files"):
        with contextlib.suppress(FileExistsError):
            each.mkdir(mode=0o700)
        found = each.lstat()
        if not stat.S_ISDIR(found.st_mode) or found.st_uid != user or found.st_mode & 0o022:
            return Path(tempfile.mkdtemp(prefix="bot-console-"))
    return ours / "files"
