"""Which processes behind a router are frozen or stopped in a debugger: it declares a token for each to its clients.

Zenoh itself considers such a process alive for a long time, or for ever, and a client cannot read the states of
processes on another machine.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping

from bot_console.runtime.process.virtual.child_threads import start_outside
from bot_console.runtime.rmw.zenoh.declarations import Declaration
from bot_console.runtime.rmw.zenoh.session import Session

TOKEN = "@bot_console_stopped/"
"""Prefix of the token of a frozen process; the first 8 digits of its session's id and its pid follow."""
DEBUGGED_TOKEN = "@bot_console_debugged/"
"""The prefix for a process in a debugger; the current line follows, as hexadecimal digits after an x."""
MAX_LINE_BYTES = 1000
FROZEN_POLL_S = 0.25
"""Interval between two checks, in seconds."""


class StoppedTokens:
    """Declares a token for each frozen or debugged process of a router's mesh, in a separate thread until `end`."""

    def __init__(
        self, session: Session, stopped: Callable[[], Mapping[str, int]], debugged: Callable[[], Mapping[str, str]]
    ) -> None:
        self._session = session
        self._stopped = stopped
        self._debugged = debugged
        self._shown: dict[str, Declaration] = {}
        self._ended = threading.Event()
        start_outside(threading.Thread(target=self._run, name="stopped-tokens", daemon=True))

    def end(self) -> None:
        """Stop checking."""
        self._ended.set()

    def _run(self) -> None:
        while not self._ended.wait(FROZEN_POLL_S):
            try:
                self.poll()
            except (OSError, RuntimeError):  # the folder is refused for now, or the session is closing
                continue

    def poll(self) -> None:
        """Declare tokens for the processes that are stopped now, and undeclare all others."""
        now = {f"{TOKEN}{zid}/{pid}" for zid, pid in self._stopped().items()}
        now |= {f"{DEBUGGED_TOKEN}{zid}/{_encoded(line)}" for zid, line in self._debugged().items()}
        for each in self._shown.keys() - now:
            self._shown.pop(each).undeclare()
        for each in now - self._shown.keys():
            self._shown[each] = self._session.declare_token(each)


class StoppedBehindRouter:
    """Tracks which processes a router reports as frozen or in a debugger."""

    def __init__(self, session: Session) -> None:
        self._found: dict[str, int] = {}
        self._lines: dict[str, str] = {}
        session.watch_tokens(f"{TOKEN}*/*", self._seen)
        session.watch_tokens(f"{DEBUGGED_TOKEN}*/*", self._seen_in_debugger)

    def _seen(self, key: str, came: bool) -> None:
        """Handle a token; one with an unexpected name comes from another program and is ignored."""
        zid, _, pid = key.removeprefix(TOKEN).partition("/")
        if came and pid.isascii() and pid.isdecimal():
            self._found[zid] = int(pid)
        elif not came:
            self._found.pop(zid, None)

    def _seen_in_debugger(self, key: str, came: bool) -> None:
        zid, _, text = key.removeprefix(DEBUGGED_TOKEN).partition("/")
        line = _decoded(text)
        if line is None:
            return
        if came:
            self._lines[zid] = line
        elif self._lines.get(zid) == line:  # otherwise the next line's token came first
            del self._lines[zid]

    def now(self) -> Mapping[str, int]:
        """Return the frozen processes: the first 8 digits of their session ids, mapped to their pids. Thread-safe."""
        return self._found.copy()

    def debugged(self) -> Mapping[str, str]:
        """Return the processes in a debugger: the first 8 digits of their session ids, with the line. Thread-safe."""
        return self._lines.copy()


def _encoded(line: str) -> str:
    return "x" + line.encode("utf-8", "surrogateescape")[:MAX_LINE_BYTES].hex()


def _decoded(text: str) -> str | None:
    """Return the line in a token; None if another program has declared the token."""
    if text[:1] != "x" or len(text) > 1 + 2 * MAX_LINE_BYTES:
        return None
    try:
        return bytes.fromhex(text[1:]).decode("utf-8", "replace")
    except ValueError:
        return None
