"""The sockets of a domain's folder: one per process, named `<pid>.<first 8 digits of its session's id>`.

Zenoh keeps `<socket>.lock` locked while the process lives, so a socket whose lock can be acquired is dead. Without Unix
sockets, a file that names a port, with another suffix, takes the place of each socket. Other files in the folder are
left alone.
"""

from __future__ import annotations

import contextlib
import os
import re
from typing import NamedTuple

from bot_console.runtime.process.unpatched import getpid
from bot_console.runtime.process.watch.processor_time import ENDED_STATES, state_and_seconds
from bot_console.runtime.rmw.zenoh.domain import loopback
from bot_console.runtime.rmw.zenoh.domain.debugger_note import remove_note
from bot_console.runtime.rmw.zenoh.domain.file_lock import open_lock, try_lock
from bot_console.runtime.rmw.zenoh.domain.folder import names_in
from bot_console.runtime.rmw.zenoh.settings import SCHEME

_NAME = re.compile(r"(\d+)\.([0-9a-f]{8})")


class Socket(NamedTuple):
    """The socket of a process. `zid` holds the first 8 digits of its session's id."""

    path: str
    pid: int
    zid: str

    @property
    def lock(self) -> str:
        """The file that is locked while the process lives."""
        return self.path + ".lock"

    def endpoint(self) -> str:
        """Return the endpoint that Zenoh connects to; empty if the process ended before it wrote one."""
        return loopback.endpoint(self.path) if self.path.endswith(loopback.SUFFIX) else SCHEME + self.path

    def is_dead(self) -> bool:
        """Whether nobody listens on the socket any more."""
        try:
            handle = open_lock(self.lock)
        except OSError:
            return False
        try:
            return try_lock(handle)  # if another process holds the lock, that process is alive
        except OSError:
            return True
        finally:
            os.close(handle)

    def is_stopped(self) -> bool:
        """Whether the socket's process is frozen (SIGSTOP, a debugger, a suspended job)."""
        return is_stopped(self.pid)

    def remove(self) -> None:
        """Remove the socket, its lock file and its debugger note.

        Anything that cannot be removed, such as a folder with such a name, is left; it does no harm.
        """
        for path in (self.path, self.lock):
            with contextlib.suppress(OSError):
                os.unlink(path)
        remove_note(os.path.dirname(self.path), self.pid)


def own_socket(folder: str, zid: str) -> Socket:
    """Return the socket for a session of this process to listen on."""
    path = os.path.join(folder, f"{getpid()}.{zid[:8]}{_suffix()}")
    return Socket(path, getpid(), zid[:8])


def sockets(folder: str) -> list[Socket]:
    """List all sockets in a folder, including dead ones; none if the folder was deleted, until it is made again."""
    found, ending = list[Socket](), _suffix()
    for name in sorted(names_in(folder)):
        match = _NAME.fullmatch(name.removesuffix(ending)) if name.endswith(ending) else None
        if match:
            found.append(Socket(os.path.join(folder, name), int(match[1]), match[2]))
    return found


def live_sockets(folder: str) -> list[Socket]:
    """List the sockets that are alive and remove the dead ones. Call only with the folder's lock held."""
    live: list[Socket] = []
    for each in sockets(folder):
        if each.is_dead():
            each.remove()
        else:
            live.append(each)
    return live


def _suffix() -> str:
    """Return the names' suffix, as processes that use ports cannot be linked to processes that use sockets."""
    return loopback.SUFFIX if loopback.is_chosen() else ""


def is_stopped(pid: int) -> bool:
    """Whether a process is frozen; False if the system does not tell."""
    reported = state_and_seconds(str(pid))
    return reported is not None and reported[0] in ("T", "t")


def process_exists(pid: int) -> bool:
    """Whether a process exists; always True on Windows, where asking would kill it.

    A process that has ended does not count, even if its parent has not reaped it yet (a zombie).
    """
    if os.name == "nt":
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    reported = state_and_seconds(str(pid))
    return reported is None or reported[0] not in ENDED_STATES
