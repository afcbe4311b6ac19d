"""Probe whether a link is alive, by pinging its other end repeatedly.

The link itself would notice a cut cable only after its lease, which the other side chooses (10 s by default).
"""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from bot_console.runtime.process.virtual.child_threads import start_outside

PING_PERIOD_S = 0.4
"""Interval between pings, in seconds."""
DISTRUST_AFTER_S = 5.0
"""Time without an answer, in seconds, after which the next answer is not trusted: after ten seconds Zenoh gives up a
link and ends all queries as if they had been answered.
"""
PING_TIMEOUT_S = 10.0
"""Timeout of a ping, in seconds; on a full link an answer arrives late, but still counts."""
FIRST_PING_S, PING_POLL_S = 0.001, 0.02
"""Polling intervals, in seconds: shortly after a ping, and after that."""

Answer = Callable[[], "bool | None"]
"""Whether a ping was answered; None while the answer may still come."""
Ask = Callable[[float], Answer]
"""Sends a ping with a timeout in seconds."""


@dataclass(frozen=True)
class LinkState:
    """The state of a link: when it last answered (s, monotonic clock), and how long that answer took (s)."""

    to: str = ""
    """The other end, such as `tcp/robot:7447`."""
    last_answer: float | None = None
    delay: float | None = None
    lost: int = 0
    """Number of messages that were lost or found no room in a queue here, judging by gaps in their sequence numbers."""


class LinkProbe:
    """Pings in a separate thread until `end` is called; a ping does not wait for the answer to the previous one."""

    def __init__(self, ask: Ask, to: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._ask = ask
        self._clock = clock
        self._unanswered: list[tuple[float, Answer]] = []
        """Unanswered pings and when they were sent; the oldest first."""
        now = clock()
        self._last_ping = now - PING_PERIOD_S
        self._last_answer = self._trusted_since = now
        """When the last answer came, and from which time of sending on a ping's answer is trusted."""
        self.state = LinkState(to, now)  # the link has just been opened
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="link-probe", daemon=True)
        start_outside(self._thread)

    def end(self) -> None:
        """Stop pinging."""
        self._ended.set()

    def _run(self) -> None:
        pause = PING_PERIOD_S
        while not self._ended.wait(pause):
            pause = self.poll()

    def poll(self) -> float:
        """Send a ping if one is due and collect answers; return the seconds until the next call."""
        with contextlib.suppress(RuntimeError):  # the session is being closed
            self._ask_if_due()
            self._take_answers()
        since = self._clock() - self._last_ping
        if not self._unanswered:
            return max(FIRST_PING_S, PING_PERIOD_S - since)
        return FIRST_PING_S if since < PING_POLL_S else PING_POLL_S

    def _ask_if_due(self) -> None:
        if self._clock() - self._last_ping >= PING_PERIOD_S:
            self._last_ping = self._clock()
            self._unanswered.append((self._last_ping, self._ask(PING_TIMEOUT_S)))

    def _take_answers(self) -> None:
        for asked, answer in [*self._unanswered]:
            answered = answer()
            if answered is not None:
                self._unanswered.remove((asked, answer))
            if answered:
                self._accept(asked)

    def _accept(self, asked: float) -> None:
        """Accept an answer, unless its ping was pending during a long silence."""
        now = self._clock()
        if now - self._last_answer > DISTRUST_AFTER_S:
            self._trusted_since = now
        self._last_answer = now
        if asked >= self._trusted_since:
            self.state = replace(self.state, last_answer=now, delay=now - asked)
