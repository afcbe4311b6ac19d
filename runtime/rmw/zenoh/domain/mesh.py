"""A session in a domain's mesh: the processes of one user on one machine, each linked to all others."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Generator, Mapping, Sequence
from typing import TYPE_CHECKING

from bot_console.runtime.rmw.qos_matching import DDS, RMW_ZENOH, QosRules
from bot_console.runtime.rmw.zenoh.domain import loopback
from bot_console.runtime.rmw.zenoh.domain.debugger_note import debugger_lines
from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.runtime.rmw.zenoh.domain.joining import folder_lock, remove_dead
from bot_console.runtime.rmw.zenoh.domain.roll_call import await_answers
from bot_console.runtime.rmw.zenoh.domain.sockets import live_sockets, own_socket, sockets
from bot_console.runtime.rmw.zenoh.domain.watch import Watch
from bot_console.runtime.rmw.zenoh.session import ROLL_CALL_KEY, Session, SessionError
from bot_console.runtime.rmw.zenoh.settings import SCHEME, Serving, session_settings

if TYPE_CHECKING:
    from bot_console.runtime.rmw.zenoh.network.frozen_processes import StoppedTokens


SETTLE_TIMEOUT_S = 5.0
"""How long a reopened session waits for the answers of the other processes, in s; 50 processes take 0.1 s."""


FROZEN_TIMEOUT_S = 0.2
"""Timeout of a graph query if a process is frozen, in s; running processes answer within 5 ms."""

PORTS = 5
"""How many ports are tried for listening if there are no Unix sockets."""


class MeshSession(Session):
    """A session that listens on a socket in the domain's folder and connects to all other sockets there."""

    def __init__(self, domain: int, serving: Serving | None = None) -> None:
        """If `serving` is given, the session also accepts links from other machines."""
        super().__init__(domain)
        self._serving = serving
        self._opened = False
        self._rules: dict[str, QosRules] = {}
        self._watch: Watch | None = None
        self._tokens: StoppedTokens | None = None
        self._port: loopback.OpenPort | None = None
        with self._socket_path() as folder:
            self._join(folder)
        self.declare_token(ROLL_CALL_KEY + self.zid[:8])

    @contextlib.contextmanager
    def _socket_path(self) -> Generator[str]:
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
        """Join without Unix sockets; tries another port if another process takes the one just found."""
        if self._serving:
            raise SessionError(
                f"other machines can join only on systems with Unix sockets, and not with {loopback.VARIABLE}"
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

    def _open_among(self, folder: str, listen: str, auth: Mapping[str, object] | None = None) -> None:
        """Open the session, listening on an endpoint and linked to all processes in the folder."""
        self.joined = tuple(each for each in live_sockets(folder) if each != self.socket)
        others = [place for each in self.joined if (place := each.endpoint())]
        settings = session_settings(self._link_id(), listen, others, self._serving, auth)
        try:
            self._open(settings)
        except SessionError as error:
            places: Sequence[str] = (listen.removeprefix(SCHEME), *(self._serving.endpoints if self._serving else ()))
            raise SessionError(f"cannot listen on {' and '.join(places)}: {error}") from None

    def _link_id(self) -> str:
        """Return the session's id for Zenoh, which changes with each reopening except for its first 8 digits.

        Another process may never give up its half-made link to the closed session, and would use it to answer the
        queries of a session with the same id.
        """
        first, self._opened = not self._opened, True
        return self.zid if first else f"{self.zid[:8]}{os.urandom(12).hex()}"

    def qos_rules(self, zid: str) -> QosRules:
        """Return the domain's rules for sessions of the mesh, rmw_zenoh's for nodes behind a router."""
        if zid not in self._rules:
            self._rules[zid] = RMW_ZENOH if self.pid_of(zid) is None else DDS
        return self._rules[zid]

    def watch(self) -> None:
        """Watch the session's place in the mesh while it is open; not for short-lived programs."""
        if not self._watch:
            self._watch = Watch(self)
            self._watch.begin()
        if self._serving and not self._tokens:
            from bot_console.runtime.rmw.zenoh.network.frozen_processes import StoppedTokens

            self._tokens = StoppedTokens(self, self.stopped, self.debugged)

    def rejoin(self, needed: Callable[[str], bool]) -> None:
        """Reopen the session if it is `needed` (called with the folder's lock held), and declare everything again."""
        with self._socket_path() as folder:
            if not needed(folder):
                return
        # Closed without the folder's lock: closing takes seconds if another process is frozen, and may hang in a
        # process whose program has closed our file descriptors.
        try:
            is_open = self._reopen(self._rejoin)
            if is_open:
                await_answers(self, SETTLE_TIMEOUT_S)
        finally:
            self._settle()
        if is_open:
            self.settled.set()
            self.on_rejoin()
        else:
            self._take_out()

    def _rejoin(self) -> None:
        with self._socket_path() as folder:
            self._join(folder)

    def links_directly(self) -> bool:
        """Whether no process of the mesh serves other machines and answers on their behalf."""
        with contextlib.suppress(self.errors()):
            return not self._serving and not list(self._zenoh.info.routers_zid())
        return False

    def answer_timeout_s(self) -> float:
        """Return the timeout of a graph query, in s: short if a process is frozen."""
        return FROZEN_TIMEOUT_S if self.stopped() else self.timeout_s

    def stopped(self) -> Mapping[str, int]:
        """Return the frozen processes of the mesh: the first 8 digits of their session ids, mapped to their pids."""
        found = sockets(os.path.dirname(self.socket.path))
        return {each.zid: each.pid for each in found if each != self.socket and each.is_stopped()}

    def processes(self) -> Mapping[str, int]:
        """Return all processes of the mesh, including this one."""
        return {each.zid: each.pid for each in sockets(os.path.dirname(self.socket.path))}

    def debugged(self) -> Mapping[str, str]:
        """Return the mesh's processes stopped in a debugger: the first 8 digits of their session ids, with the line."""
        folder = os.path.dirname(self.socket.path)
        lines = debugger_lines(folder)
        return {each.zid: lines[each.pid] for each in sockets(folder) if each.pid in lines} if lines else {}

    def pid_of(self, zid: str) -> int | None:
        """Return the pid of the process that has another session of the mesh."""
        found = sockets(os.path.dirname(self.socket.path))
        return next((each.pid for each in found if zid.startswith(each.zid)), None)

    def close(self) -> None:
        """Leave the mesh and discard all declarations; does nothing if it has already been left."""
        self._stop_polling()
        super().close()
        self._take_out()

    def leave(self) -> None:
        """Remove the socket from the folder, for a process that exits at once without waiting for `close`."""
        self._stop_polling()
        self._take_out()

    def _take_out(self) -> None:
        if self._port:
            self._port.close()
        self.socket.remove()
        if self._watch:  # a long-lived process, so nodes that it started may have died
            remove_dead(os.path.dirname(self.socket.path))

    def _stop_polling(self) -> None:
        super()._stop_polling()
        for each in (self._watch, self._tokens):
            if each:
                each.end()


def open_session(domain: int) -> MeshSession:
    """Join the mesh of a domain.

    Raises `FolderRefusedError` and `SessionError`, whose messages say how to fix it.
    """
    return MeshSession(domain)
