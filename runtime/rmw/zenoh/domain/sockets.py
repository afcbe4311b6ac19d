"""The sockets of a domain's folder: one per process, named `<pid>.<begin of its session's id>`.

`<socket>.lock` is locked for as long as the process lives (Zenoh does that), so a socket whose lock can be taken is
dead. Where there are no Unix sockets, a file that names a port takes the place of each, with another ending. A folder
may hold other files; they are left alone.
"""

from __future__ import annotations

import contextlib
import os
import re
from typing import NamedTuple

from bot_console.runtime.process.real import getpid
from bot_console.runtime.rmw.zenoh.domain import loopback
from bot_console.runtime.rmw.zenoh.domain.file_lock import NO_LINK, try_lock
from bot_console.runtime.rmw.zenoh.settings import SCHEME

_NAME = re.compile(r"(\d+)\.([0-9a-f]{8})")


class Socket(NamedTuple):
    """The socket of a process. `zid` holds the first eight digits of its session's id."""

    path: str
    pid: int
    zid: str

    @property
    def lock(self) -> str:
        """The file that is locked while its process lives."""
        return self.path + ".lock"

    def endpoint(self) -> str:
        """What Zenoh connects to; empty where the process ended before it said."""
        return loopback.endpoint(self.path) if self.path.endswith(loopback.SUFFIX) else SCHEME + self.path

    def is_dead(self) -> bool:
        """Whether nobody listens on it any more."""
        try:
            handle = os.open(self.lock, os.O_RDWR | os.O_CREAT | NO_LINK, 0o600)
        except OSError:
            return False
        try:
            return try_lock(handle)  # where another holds it, its process lives
        except OSError:
            return True
        finally:
            os.close(handle)

    def is_stopped(self) -> bool:
        """Whether its process is frozen (SIGSTOP, a debugger, a suspended job)."""
        return is_stopped(self.pid)

    def remove(self) -> None:
        """Take its two files away."""
        for path in (self.path, self.lock):
            with contextlib.suppress(FileNotFoundError):
                os.unlink(path)


def own_socket(folder: str, zid: str) -> Socket:
    """The socket that a session of this process is to listen on."""
    path = os.path.join(folder, f"{getpid()}.{zid[:8]}{_ending()}")
    return Socket(path, getpid(), zid[:8])


def sockets(folder: str) -> list[Socket]:
    """All sockets in a folder, dead ones too."""
    found, ending = list[Socket](), _ending()
    for name in sorted(os.listdir(folder)):
        match = _NAME.fullmatch(name.removesuffix(ending)) if name.endswith(ending) else None
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


def _ending() -> str:
    """What ends the names: those that meet on ports and those that meet on sockets cannot be linked."""
    return loopback.SUFFIX if loopback.is_chosen() else ""


def is_stopped(pid: int) -> bool:
    """Whether a process is frozen; False where the system does not tell."""
    return _state(pid) in (b"T", b"t")


def lives(pid: int) -> bool:
    """Whether there is such a process; True where it cannot be asked without ending it (Windows).

    One that has ended lives no more, even if its parent has not taken note of it yet (a zombie).
    """
    if os.name == "nt":
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return _state(pid) not in (b"Z", b"X")


def _state(pid: int) -> bytes:
    """The letter by which the system tells how a process is; empty where it does not."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            return file.read().rpartition(b")")[2].split()[0]
    except (OSError, IndexError):
        return b""
