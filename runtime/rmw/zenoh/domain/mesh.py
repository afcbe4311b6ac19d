"""A session's place in the mesh of a domain: the processes of one user on one machine, each linked to all others."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Generator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.zenoh.domain import loopback
from bot_console.runtime.rmw.zenoh.domain.attendance import await_answers
from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.runtime.rmw.zenoh.domain.joining import folder_lock, remove_dead
from bot_console.runtime.rmw.zenoh.domain.sockets import live_sockets, own_socket, sockets
from bot_console.runtime.rmw.zenoh.domain.watch import Watch
from bot_console.runtime.rmw.zenoh.session import ATTENDANCE, Session, SessionError
from bot_console.runtime.rmw.zenoh.settings import SCHEME, Serving, session_settings

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.network.stopped import StoppedTokens


SETTLING = 5.0
"""How long a session that was opened anew waits for the answers of the others, in s; 50 processes take 0.1 s."""


PORTS = 5
"""So many ports are tried to listen on, where there are no Unix sockets."""


class MeshSession(Session):
    """A session that listens on a socket in the folder of the domain and connects to all others there."""

    def __init__(self, domain: int, serving: Serving | None = None) -> None:
        """With `serving` it is the way in for other machines, too."""
        super().__init__(domain)
        self._serving = serving
        self._opened = False
        self._watch: Watch | None = None
        self._tokens: StoppedTokens | None = None
        self._port: loopback.OpenPort | None = None
        with self._door() as folder:
            self._join(folder)
        self.declare_token(ATTENDANCE + self.zid[:8])

    @contextlib.contextmanager
    def _door(self) -> Generator[str]:
        folder = domain_folder(self.domain)
        with folder_lock(folder):
            yield folder

    def _join(self, folder: str) -> None:
        if loopback.is_chosen():
            self._join_on_port(folder)
            return
        self.socket = own_socket(folder, self.zid)
        self._open_among(folder, self.socket.endpoint())

    def _join_on_port(self, folder: str) -> None:
        """The same where there are no Unix sockets; another port is tried where somebody takes the one just found."""
        if self._serving:
            raise SessionError(
                f"other machines are let in only where there are Unix sockets, and not by {loopback.VARIABLE}"
            )
        self.socket = own_socket(folder, self.zid)
        for tries_left in reversed(range(PORTS)):
            if self._port:
                self._port.close()
            try:
                auth, self._port = loopback.authentication(folder), loopback.OpenPort(self.socket.path)
                self._open_among(folder, self._port.endpoint, auth)
                return
            except OSError as error:
                raise SessionError(f"cannot write in {folder}: {error.strerror}") from None
            except SessionError:
                if not tries_left:
                    raise

    def _open_among(self, folder: str, listen: str, auth: Mapping[str, Any] | None = None) -> None:
        """Open the session, listening on an endpoint, with links to all that are in the folder."""
        self.joined = tuple(each for each in live_sockets(folder) if each != self.socket)
        others = [place for each in self.joined if (place := each.endpoint())]
        settings = session_settings(self._link_id(), listen, others, self._serving, auth)
        try:
            self._open(settings)
        except SessionError as error:
            places: Sequence[str] = (listen.removeprefix(SCHEME), *(self._serving.endpoints if self._serving else ()))
            raise SessionError(f"cannot listen on {' and '.join(places)}: {error}") from None

    def _link_id(self) -> str:
        """The id that Zenoh is to know the session by; another one each time it is opened, but for its begin.

        Another's half-made link to the session that was closed may count for ever, and questions of one with the same
        id would be answered into it.
        """
        first, self._opened = not self._opened, True
        return self.zid if first else f"{self.zid[:8]}{os.urandom(12).hex()}"

    def watch(self) -> None:
        """Look after the session's place in the mesh for as long as it is open; not for short-lived programs."""
        if not self._watch:
            self._watch = Watch(self)
            self._watch.begin()
        if self._serving and not self._tokens:
            from bot_console.runtime.rmw.zenoh.network.stopped import StoppedTokens

            self._tokens = StoppedTokens(self, self.stopped)

    def rejoin(self, needed: Callable[[str], bool]) -> None:
        """Open the session anew where that is `needed` (asked with the folder's lock held), and declare all again."""
        with self._door() as folder:
            if not needed(folder):
                return
        # Closed without the folder's lock: it takes seconds beside a frozen process, and may hang in one whose program
        # has closed descriptors of ours.
        try:
            is_open = self._reopen(self._join_anew)
            if is_open:
                await_answers(self, SETTLING)
        finally:
            self._settle()
        if is_open:
            self.settled.set()
            self.on_rejoin()
        else:
            self._take_out()

    def _join_anew(self) -> None:
        with self._door() as folder:
            self._join(folder)

    def links_directly(self) -> bool:
        """Whether no process of the mesh is the way in for other machines, for which it answers."""
        with contextlib.suppress(self.errors()):
            return not self._serving and not list(self._zenoh.info.routers_zid())
        return False

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
        if self._port:
            self._port.close()
        self.socket.remove()
        if self._watch:  # a process that has been here for long: nodes of its own may have died
            remove_dead(os.path.dirname(self.socket.path))

    def _look_no_more(self) -> None:
        for each in (self._watch, self._tokens):
            if each:
                each.end()


def open_session(domain: int) -> MeshSession:
    """Join the mesh of a domain.

    Raises `FolderRefusedError` and `SessionError`, whose texts say how to mend it.
    """
    return MeshSession(domain)
