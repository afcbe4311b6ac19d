"""The socket through which further consoles reach a launch host: `<pid>.host` in a folder private to the user."""

from __future__ import annotations

import contextlib
import os
import re
import socket
import threading
from collections.abc import Callable
from pathlib import Path

ADDRESS_SUFFIX = ".host"
_NAME = re.compile(r"\d+\.host")
BACKLOG = 8


class HostListener:
    """Accepts consoles until it is closed."""

    def __init__(self, folder: str, enter: Callable[[socket.socket], None]) -> None:
        """`enter` receives each connection. Raises `OSError` if no socket can be created in the folder."""
        self.path = address_of(folder, os.getpid())
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._enter = enter
        early = f"{self.path}.new"
        with contextlib.suppress(FileNotFoundError):  # left by an earlier process with the same pid
            os.unlink(early)
        self._socket.bind(early)
        self._socket.listen(BACKLOG)
        os.rename(early, self.path)  # from now on, any program that sees the name can connect
        threading.Thread(target=self._serve, name="further consoles", daemon=True).start()

    def _serve(self) -> None:
        while True:
            try:
                connection, _ = self._socket.accept()
            except OSError:  # the socket was closed
                return
            self._enter(connection)

    def close(self) -> None:
        """Accept no more consoles."""
        with contextlib.suppress(FileNotFoundError):
            os.unlink(self.path)
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)  # wakes up the thread
        self._socket.close()


def address_of(folder: str, pid: int) -> str:
    """The path of a launch host's socket."""
    return os.path.join(folder, f"{pid}{ADDRESS_SUFFIX}")


def host_addresses(folder: str) -> list[str]:
    """The paths of all launch host sockets in a folder, including those of dead hosts."""
    return sorted(str(each) for each in Path(folder).iterdir() if _NAME.fullmatch(each.name))


def remove_addresses_of_dead_hosts(folder: str, is_alive: Callable[[int], bool]) -> None:
    """Remove the sockets that killed hosts have left in a folder; `is_alive` returns whether a process is alive."""
    for left in host_addresses(folder):
        if not is_alive(pid_of_address(left)):
            with contextlib.suppress(FileNotFoundError):
                os.unlink(left)


def pid_of_address(path: str) -> int:
    """The pid of the launch host to which a socket belongs."""
    return int(os.path.basename(path).removesuffix(ADDRESS_SUFFIX))


def connect_to_host(path: str) -> socket.socket | None:
    """Connect to a launch host; if it is dead, its socket is removed and None is returned."""
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        connection.connect(path)
    except (ConnectionRefusedError, FileNotFoundError):
        connection.close()
        with contextlib.suppress(FileNotFoundError):
            os.unlink(path)
        return None
    return connection
