"""Watches a session's links in the mesh and reopens it if they are lost; records whether a debugger has stopped us.

Three things can go wrong after a process has joined: its socket is removed from the folder (by a cleaner of temporary
files, or by hand), so that later processes do not see it; a process that joined without the lock has no link to it; or
a link carries nothing, because Zenoh gave up opening it half-way (`OPEN_TIMEOUT_MS`) but never gives up the link
itself. Each new link is queried once for an answer of the other side; keep-alives are not enough, as some such links
carry these but no queries.
"""

from __future__ import annotations

import contextlib
import os
import threading
import time
from collections.abc import Callable
from typing import Protocol

from bot_console.runtime.process.virtual.child_threads import start_outside
from bot_console.runtime.rmw.zenoh.domain.debugger_note import update_note
from bot_console.runtime.rmw.zenoh.domain.sockets import Socket, is_stopped, live_sockets, sockets

SOCKET_POLL_S = 1.0
"""Interval between checks of the session's own socket, in s."""

PROCESSES_POLL_S = 5.0
"""Minimum interval between checks of the other processes, in s.

It lets processes that start together be checked and queried once: when each of fifty did so once a second while the
others were starting, that was a fifth of the total cost.
"""

LINK_TIMEOUT_S = 15.0
"""How long, in s, another process may have no link, or a link without any answer, before that counts as a fault; it
takes time because links are made in the background.

Of two processes the one with the higher id waits twice as long, so that only one of them reopens its session; and each
doubles its wait after every reopening, up to `MAX_TIMEOUT_FACTOR` times.
"""

MAX_TIMEOUT_FACTOR = 8.0
"""The largest multiple of the grace period (`LINK_TIMEOUT_S`) on a machine that is not busy."""

BUSY_LOAD = 4.0
"""Load per processor above which a machine counts as busy. The grace period grows with the load, as making links slows
down with it: a session reopened in vain would make all others busy, too.
"""

MAX_REOPENS = 3
"""How often a session is reopened because of one other process; after that a process that never answers, for whatever
reason, is left alone.
"""

ANSWER_TIMEOUT_S = 1.0
"""Timeout for an answer, in s; a running process takes 5 ms."""

LAST_ANSWER_TIMEOUT_S = 10.0
"""The timeout for the last query before the session is reopened because a process does not answer, in s."""


class WatchedSession(Protocol):
    """What the watch needs of a session."""

    zid: str
    socket: Socket

    def linked(self) -> set[str]:
        """Return the ids of the sessions that this session is linked to."""
        ...

    def watch_links(self, changed: Callable[[str, bool], None]) -> object:
        """Call back with the id of each session that is or gets linked (True), or whose link is lost (False)."""
        ...

    def answering_sessions(self, who: str, timeout: float) -> set[str]:
        """Return the first 8 digits of the ids of the sessions matching `who` that answer within `timeout` (s)."""
        ...

    def rejoin(self, needed: Callable[[str], bool]) -> None:
        """Reopen the session if it is `needed`."""
        ...


class Watch:
    """Checks a session's folder once a second, in a separate thread that `end` stops."""

    def __init__(self, session: WatchedSession, clock: Callable[[], float] = time.monotonic) -> None:
        self._session = session
        self._clock = clock
        self._ended = threading.Event()
        self._folder_state: tuple[int, int] | None = None
        self._next_poll = 0.0
        self._is_calm = False
        self._cut_links: set[str] = set()
        self._answered: set[Identity] = set()
        self._since: dict[Identity, float] = {}
        self._next_query, self._pause = 0.0, SOCKET_POLL_S
        self._lost: set[Identity] = set()
        self._reopens_for: dict[str, int] = {}
        self._reopens = 0
        session.watch_links(self._link_changed)

    def begin(self) -> None:
        """Start watching."""
        thread = threading.Thread(target=self._run, name="zenoh-watch", daemon=True)
        thread.pydev_do_not_trace = True  # pyright: ignore[reportAttributeAccessIssue] -- debugpy must not stop it, too
        start_outside(thread)

    def end(self) -> None:
        """Stop watching."""
        self._ended.set()

    def _link_changed(self, zid: str, there: bool) -> None:
        """Handle a link that was made or lost; called on one of Zenoh's threads."""
        if not there:
            self._cut_links.add(zid[:8])

    def _run(self) -> None:
        while not self._ended.wait(SOCKET_POLL_S):
            with contextlib.suppress(OSError, RuntimeError):  # for example, the folder is refused for now; tried again
                update_note(os.path.dirname(self._session.socket.path))
                if self.has_lost_its_place():
                    self._session.rejoin(self._still_lost)

    def has_lost_its_place(self) -> bool:
        """Whether the socket is gone from the folder, or a running process has had no working link for too long."""
        own = self._session.socket
        try:
            state = os.stat(os.path.dirname(own.path))
            os.lstat(own.path)
        except FileNotFoundError:
            return True
        now = self._clock()
        if now < self._next_poll:
            return False
        before, self._folder_state = self._folder_state, (state.st_ino, state.st_mtime_ns)
        if self._is_calm and not self._cut_links and self._folder_state == before:
            return False
        self._next_poll = now + PROCESSES_POLL_S
        found = sockets(os.path.dirname(own.path))
        without = self._without_link(found)
        self._since = {each: self._since.get(each, now) for each in self._running(without)}
        busy = slowness()
        due = {each for each, since in self._since.items() if now - since >= self._grace(each) * busy}
        if due or self._is_query_due(now):
            self._ask(due)
            without = self._without_link(found)
            self._since = {each: since for each, since in self._since.items() if each not in self._answered}
        self._is_calm = not without
        self._lost = due - self._answered
        return bool(self._lost)

    def _grace(self, other: Identity) -> float:
        times = min(2.0**self._reopens, MAX_TIMEOUT_FACTOR)
        return LINK_TIMEOUT_S * times * (2.0 if other[0] < self._session.zid[:8] else 1.0)

    def _is_query_due(self, now: float) -> bool:
        """Whether it is time to query the processes that are not yet overdue; the intervals get longer."""
        if not self._since:
            self._pause = SOCKET_POLL_S
        if now < self._next_query or not any(now - since >= SOCKET_POLL_S for since in self._since.values()):
            return False
        self._next_query, self._pause = now + self._pause, self._pause * 2
        return True

    def _ask(self, due: set[Identity]) -> None:
        """Query the linked processes, with the longer timeout if some of them are about to be given up."""
        linked = {zid[:8] for zid in self._session.linked()}
        asked = {zid for zid, _ in self._since if zid in linked}
        if asked:
            who = "*" if len(asked) > 1 else min(asked)  # a query by name spares fifty others the answer
            answered = self._session.answering_sessions(who, LAST_ANSWER_TIMEOUT_S if due else ANSWER_TIMEOUT_S)
            self._answered |= {each for each in self._since if each[0] in answered}

    def _still_lost(self, folder: str) -> bool:
        """Check again with the folder's lock held and dead sockets removed: another process may have fixed it."""
        live = live_sockets(folder)
        lost = self._running(self._without_link(live)) & self._lost
        for zid, _ in lost:
            self._reopens_for[zid] = self._reopens_for.get(zid, 0) + 1
        self._reopens += bool(lost)
        self._answered.clear()
        self._since.clear()
        self._next_poll = 0.0
        self._is_calm = False
        return bool(lost) or self._session.socket not in live

    def _without_link(self, found: list[Socket]) -> list[Socket]:
        """Return the sockets to which the session has no link, or a link over which no answer has come yet."""
        cut, self._cut_links = self._cut_links, set()
        self._answered = {each for each in self._answered if each[0] not in cut}
        linked = {zid[:8] for zid in self._session.linked()}
        works = {zid for zid, _ in self._answered & {identity(each) for each in found}} & linked
        return [each for each in found if each.zid not in works and each.zid != self._session.zid[:8]]

    def _running(self, found: list[Socket]) -> set[Identity]:
        """Return the processes that are not frozen and have not yet made the session reopen too often."""
        running = {identity(each) for each in found if not is_stopped(each.pid)}
        return {each for each in running if self._reopens_for.get(each[0], 0) < MAX_REOPENS}


Identity = tuple[str, int]
"""The identity of a socket, which distinguishes it from a later one at its path: session id and inode number."""


def identity(socket: Socket) -> Identity:
    """Return what distinguishes a socket from a later one at the same path."""
    try:
        return socket.zid, os.lstat(socket.path).st_ino
    except OSError:
        return socket.zid, 0


def slowness() -> float:
    """Return how many times longer things take as the machine is busy; 1 if it is not, or if the load is unknown."""
    try:
        load, *_ = os.getloadavg()
    except (OSError, AttributeError):
        return 1.0
    return max(1.0, load / (os.cpu_count() or 1) / BUSY_LOAD)
