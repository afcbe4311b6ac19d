"""Which processes behind a router are frozen: the router declares a token for each, which its clients watch.

Zenoh itself considers a frozen process alive until its lease expires, and a client cannot read the states of processes
on another machine.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping

from bot_console.runtime.rmw.zenoh.declarations import Declaration
from bot_console.runtime.rmw.zenoh.session import Session

TOKEN = "@bot_console_stopped/"
"""Prefix of such a token; the first 8 digits of the session's id and the process's pid follow."""
FROZEN_POLL_S = 0.25
"""Interval between two checks, in seconds."""


class StoppedTokens:
    """Declares a token for each frozen process of a router's mesh, in a separate thread until `end`."""

    def __init__(self, session: Session, stopped: Callable[[], Mapping[str, int]]) -> None:
        self._session = session
        self._stopped = stopped
        self._shown: dict[tuple[str, int], Declaration] = {}
        self._ended = threading.Event()
        threading.Thread(target=self._run, name="stopped-tokens", daemon=True).start()

    def end(self) -> None:
        """Stop checking."""
        self._ended.set()

    def _run(self) -> None:
        while not self._ended.wait(FROZEN_POLL_S):
            try:
                self.poll()
            except (OSError, RuntimeError):  # the folder is refused for now, or the session is being closed
                continue

    def poll(self) -> None:
        """Declare tokens for the processes that are frozen now, and undeclare all others."""
        now = set(self._stopped().items())
        for each in self._shown.keys() - now:
            self._shown.pop(each).undeclare()
        for zid, pid in now - self._shown.keys():
            self._shown[zid, pid] = self._session.declare_token(f"{TOKEN}{zid}/{pid}")


class StoppedBehind:
    """Tracks which processes a router reports as frozen."""

    def __init__(self, session: Session) -> None:
        self._found: dict[str, int] = {}
        session.watch_tokens(f"{TOKEN}*/*", self._seen)

    def _seen(self, key: str, came: bool) -> None:
        """Take in a token; one with a foreign name comes from another program and is ignored."""
        zid, _, pid = key.removeprefix(TOKEN).partition("/")
        if came and pid.isascii() and pid.isdecimal():
            self._found[zid] = int(pid)
        elif not came:
            self._found.pop(zid, None)

    def now(self) -> Mapping[str, int]:
        """Return the first 8 digits of their session ids, mapped to their pids. Thread-safe."""
        return self._found.copy()
