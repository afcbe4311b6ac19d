"""Whether a link is alive: pings its other end again and again.

The link itself would notice a cut cable only after its lease, which is chosen by the other side and 10 s by default.
"""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

PERIOD = 0.4
"""Seconds from one question to the next."""
SILENCE = 5.0
"""Seconds without any answer after which the first is not believed: after ten Zenoh gives a link up, and ends all
questions as if they were answered."""
PATIENCE = 10.0
"""Seconds for which an answer is waited for; on a link that is full it comes late, and is one all the same."""
SOON, LATER = 0.001, 0.02
"""Seconds from one look for answers to the next: while one may come at once, and afterwards."""

Answer = Callable[[], "bool | None"]
"""Whether a question has been answered; None as long as that may still come."""
Ask = Callable[[float], Answer]
"""Asks once, for an answer within so many seconds."""


@dataclass(frozen=True)
class LinkState:
    """How a link is: when it last answered and how long that took (s, of the monotonic clock)."""

    to: str = ""
    """The other end, such as `tcp/robot:7447`."""
    heard: float | None = None
    delay: float | None = None
    lost: int = 0
    """Messages that did not arrive or had no room here, as far as their numbers tell."""


class LinkProbe:
    """Asks in a thread of its own until `end`; the next question does not wait for the answer to the last."""

    def __init__(self, ask: Ask, to: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._ask = ask
        self._clock = clock
        self._open: list[tuple[float, Answer]] = []
        """Questions without an answer so far, and when they were asked; the oldest first."""
        now = clock()
        self._asked = now - PERIOD
        self._came = self._believed = now
        """When the last answer came, and from when on a question was asked whose answer is believed."""
        self.state = LinkState(to, now)  # it has just been opened
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="link-probe", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Ask no more."""
        self._ended.set()

    def _run(self) -> None:
        pause = PERIOD
        while not self._ended.wait(pause):
            pause = self.look()

    def look(self) -> float:
        """Ask, if it is time to, and take the answers that have come; gives the seconds until the next look."""
        with contextlib.suppress(RuntimeError):  # the session is being closed
            self._ask_if_due()
            self._take_answers()
        since = self._clock() - self._asked
        if not self._open:
            return max(SOON, PERIOD - since)
        return SOON if since < LATER else LATER

    def _ask_if_due(self) -> None:
        if self._clock() - self._asked >= PERIOD:
            self._asked = self._clock()
            self._open.append((self._asked, self._ask(PATIENCE)))

    def _take_answers(self) -> None:
        for asked, answer in [*self._open]:
            answered = answer()
            if answered is not None:
                self._open.remove((asked, answer))
            if answered:
                self._take(asked)

    def _take(self, asked: float) -> None:
        """Believe an answer, unless the question was open over a long silence."""
        now = self._clock()
        if now - self._came > SILENCE:
            self._believed = now
        self._came = now
        if asked >= self._believed:
            self.state = replace(self.state, heard=now, delay=now - asked)
