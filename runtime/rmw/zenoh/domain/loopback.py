"""How programs meet where there are no Unix sockets: on ports of 127.0.0.1, closed by a secret.

Any user of the machine can reach such a port. So the domain's folder, which is the user's alone, holds a secret that
each link is asked for, and beside it one file per process that names its port.
"""

from __future__ import annotations

import contextlib
import os
import sys
from typing import Any

from bot_console.runtime.rmw.zenoh.domain.file_lock import NO_LINK, try_lock

VARIABLE = "BOT_CONSOLE_LOOPBACK"
"""Set to 1 it chooses these ports where there are Unix sockets, too: for folders in which none can be made."""

SUFFIX = ".tcp"
"""Ends the name of a file that names a port."""

HOST = "127.0.0.1"
USER = "bot-console"
SECRET = "secret"
"""The file of a domain's folder that holds `USER:password`, as Zenoh reads it."""


def is_chosen() -> bool:
    """Whether programs meet on ports: where there are no Unix sockets, or where the environment asks for it."""
    return sys.platform == "win32" or os.environ.get(VARIABLE, "") not in ("", "0")


class OpenPort:
    """The port of this process: named in a file of the folder, and live for as long as `<file>.lock` is locked."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._lock = os.open(path + ".lock", os.O_RDWR | os.O_CREAT | NO_LINK, 0o600)
        try_lock(self._lock)
        self.endpoint = f"tcp/{HOST}:{_free_port()}"
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | NO_LINK, 0o600)
        with os.fdopen(handle, "w") as file:
            file.write(self.endpoint)

    def close(self) -> None:
        """Give the lock back: from now on the file counts as that of a dead process. A second time does nothing."""
        lock, self._lock = self._lock, -1
        if lock >= 0:
            os.close(lock)


def endpoint(path: str) -> str:
    """What the file of a process names; empty where it ended before it wrote it."""
    with contextlib.suppress(OSError), open(path) as file:
        return file.read()
    return ""


def authentication(folder: str) -> dict[str, Any]:
    """Zenoh's settings under `transport/auth` that let only those link who can read the folder's secret.

    Makes the secret where there is none yet; to be called with the folder's lock held.
    """
    path = os.path.join(folder, SECRET)
    if not endpoint(path).startswith(f"{USER}:"):
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | NO_LINK, 0o600)
        with os.fdopen(handle, "w") as file:
            file.write(f"{USER}:{os.urandom(32).hex()}\n")
    password = endpoint(path).partition(":")[2].strip()
    return {"usrpwd": {"user": USER, "password": password, "dictionary_file": path}}


def _free_port() -> int:
    """A port that nobody uses just now: Zenoh does not tell which one it got when it chooses one itself."""
    import socket  # not for each verb, most of which meet on sockets

    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])
