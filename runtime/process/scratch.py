"""A folder for the temporary files of this process: it goes with the process, and what a killed one left is removed.

One folder for all of a user's programs, with one in it for each process. Each is locked by its process for as long as
that lives, so that the next one to start knows which are left over.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import shutil
import stat
import tempfile
from pathlib import Path

from . import real

LOCK = "lock"
OVER = ".over"
"""What the name of a folder ends with that is being removed: whoever had the old name writes into it no more."""
_made: dict[int, tuple[Path, int]] = {}
_ended: set[int] = set()
"""The process, once its end has removed what there was: nothing would remove what is made after that."""
_guard = _thread.allocate_lock()
"""Several launches of a process begin at once, and each would make a folder of which only one is remembered."""


def _after_fork() -> None:
    global _guard
    _guard = _thread.allocate_lock()  # a thread that is not here may have held it


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def scratch() -> Path:
    """The folder of this process; raises `OSError` where none can be made, and once the process is ending."""
    pid = real.getpid()
    with _guard:
        if pid in _ended:
            raise OSError("the process is ending")
        if pid not in _made or not _made[pid][0].is_dir():  # some systems clean /tmp themselves
            _make(pid)
        return _made[pid][0]


def _make(pid: int) -> None:
    base = _base()
    clean(base)
    new = Path(tempfile.mkdtemp(prefix=f".{pid}.", dir=base))
    handle = os.open(new / LOCK, os.O_RDWR | os.O_CREAT, 0o600)
    with contextlib.suppress(OSError):
        _take(handle)
    folder = new.rename(base / new.name[1:])  # whoever cleans sees it only now that it is locked
    _made.clear()  # of the process that this one was forked from
    _made[pid] = (folder, handle)
    real.at_exit(remove)


def scratch_file(prefix: str, text: str) -> Path:
    """A new file of this process with this text."""
    handle, path = tempfile.mkstemp(prefix=prefix, dir=scratch())
    with open(handle, "w", encoding="utf-8") as file:
        file.write(text)
    return Path(path)


def remove() -> None:
    """Take this process's folder away, as its end does; there is none from now on."""
    pid = real.getpid()
    with _guard:
        _ended.add(pid)
        folder, handle = _made.pop(pid, (None, -1))
    if folder is not None:
        with contextlib.suppress(OSError):  # threads of a launch may still write
            folder = folder.rename(folder.with_name(folder.name + OVER))
        _delete(folder)
        os.close(handle)


def clean(base: Path) -> None:
    """Remove the folders of processes that are no more."""
    for folder in base.glob("[0-9]*.*"):
        with contextlib.suppress(OSError):
            handle = os.open(folder / LOCK, os.O_RDWR)
            try:
                _take(handle)
                _delete(folder)
            finally:
                os.close(handle)


def _delete(folder: Path) -> None:
    """Remove a folder, its lock last: one whose removal is cut short is found by the next who cleans."""
    with contextlib.suppress(OSError):
        for each in folder.iterdir():
            if each.is_dir() and not each.is_symlink():
                shutil.rmtree(each, ignore_errors=True)
            elif each.name != LOCK:
                each.unlink()
        (folder / LOCK).unlink()
        folder.rmdir()


def _take(handle: int) -> None:
    """Lock a file for as long as it is open; raises `OSError` where another process has it, or none can be locked."""
    try:
        import fcntl
    except ImportError:  # Windows: nobody can tell what is left over, so nothing is removed
        raise OSError("no file locks here") from None
    fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _base() -> Path:
    """Beside the sockets as a rule, in a folder closed to other users; where that is not ours, one for us alone."""
    user = os.geteuid() if hasattr(os, "geteuid") else 0
    ours = Path(tempfile.gettempdir()) / f"bot-console-{user}"
    for each in (ours, ours / "files"):
        with contextlib.suppress(FileExistsError):
            each.mkdir(mode=0o700)
        found = each.lstat()
        if not stat.S_ISDIR(found.st_mode) or found.st_uid != user or found.st_mode & 0o022:
            return Path(tempfile.mkdtemp(prefix="bot-console-"))
    return ours / "files"
