"""Discovery without Unix sockets: ports of 127.0.0.1, protected by a secret.

Any user of the machine can reach such a port. Therefore the domain's folder, which is private to the user, holds a
secret that each link must present, and one file per process that names its port.
"""

from __future__ import annotations

import contextlib
import os
import sys

from bot_console.runtime.rmw.zenoh.domain.file_lock import NO_LINK, open_lock, try_lock

VARIABLE = "BOT_CONSOLE_LOOPBACK"
"""Environment variable: 1 selects ports even if there are Unix sockets; for folders that cannot hold sockets."""

SUFFIX = ".tcp"
"""Suffix of a file that names a port."""

HOST = "127.0.0.1"
USER = "bot-console"
SECRET = "secret"
"""Name of the file in a domain's folder that holds `USER:password`, in Zenoh's format."""


def is_chosen() -> bool:
    """Whether ports are used, because there are no Unix sockets or the environment asks for it."""
    return sys.platform == "win32" or os.environ.get(VARIABLE, "") not in ("", "0")


class OpenPort:
    """The port of this process: a file in the folder names it, and it counts as alive while `<file>.lock` is locked."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._lock = open_lock(path + ".lock")
        try_lock(self._lock)
        self.endpoint = f"tcp/{HOST}:{_free_port()}"
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | NO_LINK, 0o600)
        with os.fdopen(handle, "w") as file:
            file.write(self.endpoint)

    def close(self) -> None:
        """Release the lock, so that the file counts as a dead process's. Does nothing if already closed."""
        lock, self._lock = self._lock, -1
        if lock >= 0:
            os.close(lock)


def endpoint(path: str) -> str:
    """Read the endpoint from a process's file; empty if the process ended before writing it."""
    with contextlib.suppress(OSError), open(path) as file:
        return file.read()
    return ""


def authentication(folder: str) -> dict[str, object]:
    """Return Zenoh's `transport/auth` settings, which admit only links that know the folder's secret.

    Creates the secret if there is none yet. Call only with the folder's lock held.
    """
    path = os.path.join(folder, SECRET)
    if not endpoint(path).startswith(f"{USER}:"):
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | NO_LINK, 0o600)
        with os.fdopen(handle, "w") as file:
            file.write(f"{USER}:{os.urandom(32).hex()}\n")
    password = endpoint(path).partition(":")[2].strip()
    return {"usrpwd": {"user": USER, "password": password, "dictionary_file": path}}


def _free_port() -> int:
    """Return a port that is free now: Zenoh does not report which port it got if it chooses one itself."""
    import socket  # imported here because most verbs use Unix sockets and do not need it

    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])
