"""A session's place in the mesh of a domain: the processes of one user on one machine, each linked to all others."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Generator, Mapping, Sequence
from typing import TYPE_CHECKING

from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.runtime.rmw.zenoh.domain.joining import folder_lock, remove_dead
from bot_console.runtime.rmw.zenoh.domain.sockets import live_sockets, own_socket, sockets
from bot_console.runtime.rmw.zenoh.session import ATTENDANCE, Session, SessionError
from bot_console.runtime.rmw.zenoh.settings import Serving, session_settings
from bot_console.runtime.rmw.zenoh.watch import Watch

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.network.stopped import StoppedTokens


class MeshSession(Session):
    """A session that listens on a socket in the folder of the domain and connects to all others there."""

    def __init__(self, domain: int, serving: Serving | None = None) -> None:
        """With `serving` it is the way in for other machines, too."""
        super().__init__(domain)
        self._serving = serving
        self._watch: Watch | None = None
        self._tokens: StoppedTokens | None = None
        with self._door() as folder:
            self._join(folder)
        self.declare_token(ATTENDANCE + self.zid[:8])

    @contextlib.contextmanager
    def _door(self) -> Generator[str]:
        folder = domain_folder(self.domain)
        with folder_lock(folder):
            yield folder

    def _join(self, folder: str) -> None:
        self.socket = own_socket(folder, self.zid)
        self.joined = tuple(live_sockets(folder))
        settings = session_settings(self.zid, self.socket.path, [each.path for each in self.joined], self._serving)
        try:
            self._open(settings)
        except SessionError as error:
            places: Sequence[str] = (self.socket.path, *(self._serving.endpoints if self._serving else ()))
            raise SessionError(f"cannot listen on {' and '.join(places)}: {error}") from None

    def watch(self) -> None:
        """Look after the session's place in the mesh for as long as it is open; not for short-lived programs."""
        self._watch = self._watch or Watch(self)
        if self._serving and not self._tokens:
            from bot_console.runtime.rmw.zenoh.network.stopped import StoppedTokens

            self._tokens = StoppedTokens(self, self.stopped)

    def rejoin(self, needed: Callable[[str], bool]) -> None:
        """Open the session anew where that is `needed` (asked with the folder's lock held), and declare all again."""
        with self._door() as folder:
            if not needed(folder):
                return
        with self._lock:
            if self._ended:
                return
            # Not with the folder's lock: it takes seconds beside a frozen process, and may hang in one whose program
            # has closed descriptors of ours.
            self._shut()
            with self._door() as folder:
                self._join(folder)
            self._declare_again()
        self.on_rejoin()

    def stopped(self) -> Mapping[str, int]:
        """The processes of the mesh that are frozen: the first eight digits of their sessions' ids, and their pids."""
        found = sockets(os.path.dirname(self.socket.path))
        return {each.zid: each.pid for each in found if each != self.socket and each.is_stopped()}

    def close(self) -> None:
        """Leave the mesh; what was declared is gone. A second time does nothing."""
        self._look_no_more()
        super().close()
        self._take_out()

    def leave(self) -> None:
        """Take the socket out of the folder, for a process that ends at once and does not wait for `close`."""
        self._look_no_more()
        self._take_out()

    def _take_out(self) -> None:
        self.socket.remove()
        if self._watch:  # a process that has been here for long: nodes of its own may have died
            remove_dead(os.path.dirname(self.socket.path))

    def _look_no_more(self) -> None:
        for each in (self._watch, self._tokens):
            if each:
                each.end()


def open_session(domain: int) -> MeshSession:
    """Join the mesh of a domain.

    Raises `FolderRefusedError`, `PathTooLongError` and `SessionError`, whose texts say how to mend it.
    """
    return MeshSession(domain)
