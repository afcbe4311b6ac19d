"""The sockets of a domain's folder: one per process, named `<pid>.<begin of its session's id>`.

Zenoh holds a lock on `<socket>.lock` for as long as the process lives, so a socket whose lock can be taken is dead. A
folder may hold other files; they are left alone.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import re
import sys
from typing import NamedTuple

from bot_console.runtime.process.real import getpid
from bot_console.runtime.rmw.zenoh.domain.folder import BASE_VARIABLE

LONGEST_PATH = 107 if sys.platform == "linux" else 103
"""The bytes that the path of a Unix socket may have; a longer one fails silently on connecting."""

_NAME = re.compile(r"(\d+)\.([0-9a-f]{8})")


class PathTooLongError(RuntimeError):
    """A socket's path is longer than the system allows."""


class Socket(NamedTuple):
    """The socket of a process. `zid` holds the first eight digits of its session's id."""

    path: str
    pid: int
    zid: str

    @property
    def lock(self) -> str:
        """The file that is locked while its process lives."""
        return self.path + ".lock"

    def is_dead(self) -> bool:
        """Whether nobody listens on it any more."""
        try:
            handle = os.open(self.lock, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600)
        except OSError:
            return False
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            # Held, so its process lives.
            return error.errno not in (errno.EWOULDBLOCK, errno.EAGAIN)
        finally:
            os.close(handle)
        return True

    def is_stopped(self) -> bool:
        """Whether its process is frozen (SIGSTOP, a debugger, a suspended job)."""
        return is_stopped(self.pid)

    def remove(self) -> None:
        """Take its two files away."""
        for path in (self.path, self.lock):
            with contextlib.suppress(FileNotFoundError):
                os.unlink(path)


def own_socket(folder: str, zid: str) -> Socket:
    """The socket that a session of this process is to listen on; raises `PathTooLongError`."""
    path = os.path.join(folder, f"{getpid()}.{zid[:8]}")
    length = len(os.fsencode(path))
    if length > LONGEST_PATH:
        raise PathTooLongError(
            f"the path {path} has {length} bytes, and that of a socket may have {LONGEST_PATH}: "
            f"set {BASE_VARIABLE} to a shorter folder"
        )
    return Socket(path, getpid(), zid[:8])


def sockets(folder: str) -> list[Socket]:
    """All sockets in a folder, dead ones too."""
    found: list[Socket] = []
    for name in sorted(os.listdir(folder)):
        match = _NAME.fullmatch(name)
        if match:
            found.append(Socket(os.path.join(folder, name), int(match[1]), match[2]))
    return found


def live_sockets(folder: str) -> list[Socket]:
    """The sockets somebody listens on; those of the dead are removed. Only with the folder's lock held."""
    live: list[Socket] = []
    for each in sockets(folder):
        if each.is_dead():
            each.remove()
        else:
            live.append(each)
    return live


def is_stopped(pid: int) -> bool:
    """Whether a process is frozen; False where the system does not tell."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            return file.read().rpartition(b")")[2].split()[0] in (b"T", b"t")
    except (OSError, IndexError):
        return False
