"""Watches over a session's place in the mesh, and opens it anew where it has lost it.

Two things can go wrong once a process has joined: its socket is taken out of the folder (by a cleaner of temporary
files, or by hand), so that who comes later does not see it; or one that joined without the lock has no link to it.
"""

from __future__ import annotations

import contextlib
import os
import threading
import time
from collections.abc import Callable
from typing import Protocol

from bot_console.runtime.rmw.zenoh.domain.sockets import Socket, is_stopped, live_sockets, sockets

PERIOD = 1.0
"""How often the folder is looked at, in s."""

GRACE = 15.0
"""How long another process may have no link before that counts as a fault, in s: links are made in the background.

Longer than an attempt may take (`OPEN_TIMEOUT`): a session that is opened anew is cut from all others meanwhile.
"""


class Watched(Protocol):
    """What is watched: a session."""

    zid: str
    socket: Socket

    def linked(self) -> set[str]:
        """The ids of the sessions that this one has a link to."""
        ...

    def rejoin(self, needed: Callable[[str], bool]) -> None:
        """Open the session anew where that is needed."""
        ...


class Watch:
    """Looks at the folder of a session once a second, in a thread of its own that ends with the session."""

    def __init__(self, session: Watched) -> None:
        self._session = session
        self._ended = threading.Event()
        self._looked_at: tuple[int, int] | None = None
        self._unlinked: dict[tuple[str, int], float] = {}
        self._tried: set[tuple[str, int]] = set()
        threading.Thread(target=self._run, name="zenoh-watch", daemon=True).start()

    def end(self) -> None:
        """Look no more."""
        self._ended.set()

    def _run(self) -> None:
        while not self._ended.wait(PERIOD):
            with contextlib.suppress(OSError, RuntimeError):  # as where the folder is refused for now: tried again
                if self.has_lost_its_place():
                    self._session.rejoin(self._still_lost)

    def has_lost_its_place(self) -> bool:
        """Whether the socket is not listed, or a live one that was not tried yet is without link for `GRACE`."""
        own = self._session.socket
        try:
            state = os.stat(os.path.dirname(own.path))
            os.lstat(own.path)
        except FileNotFoundError:
            return True
        if (state.st_ino, state.st_mtime_ns) == self._looked_at and not self._unlinked:
            return False
        self._looked_at = (state.st_ino, state.st_mtime_ns)
        now = time.monotonic()
        without = {identity(each) for each in self._without_link(sockets(os.path.dirname(own.path)))} - self._tried
        self._unlinked = {each: self._unlinked.get(each, now) for each in without}
        return any(now - since >= GRACE for since in self._unlinked.values())

    def _still_lost(self, folder: str) -> bool:
        """The same with the folder's lock held and the dead removed: another may have mended it meanwhile."""
        live = live_sockets(folder)
        lost = {identity(each) for each in self._without_link(live)} & set(self._unlinked)
        self._tried |= lost
        self._unlinked = {}
        return bool(lost) or self._session.socket not in live

    def _without_link(self, found: list[Socket]) -> list[Socket]:
        """Those that run and that the session has no link to."""
        linked = {zid[:8] for zid in self._session.linked()} | {self._session.zid[:8]}
        return [each for each in found if each.zid not in linked and not is_stopped(each.pid)]


def identity(socket: Socket) -> tuple[str, int]:
    """What tells a socket from a later one in its place."""
    try:
        return socket.zid, os.lstat(socket.path).st_ino
    except OSError:
        return socket.zid, 0
