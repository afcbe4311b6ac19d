"""Whether a link is alive: a small question to its other end, again and again.

The link itself would notice a cut cable only after its lease, which is the other side's and 10 s by default.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

PERIOD = 0.4
"""Seconds from one question to the next."""
LONGEST = 0.9
"""Seconds that an answer is waited for before the question is asked again; a later answer counts for the next."""

Ask = Callable[[float], bool]
"""Asks once and gives whether an answer came within so many seconds."""


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
    """Asks in a thread of its own until `end`."""

    def __init__(self, ask: Ask, to: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._ask = ask
        self._clock = clock
        self._silent = False
        self.state = LinkState(to, clock())  # it has just been opened
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="link-probe", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Ask no more."""
        self._ended.set()

    def _run(self) -> None:
        while not self._ended.wait(PERIOD):
            self.look()

    def look(self) -> None:
        """Ask once. The first answer after silence may be none: Zenoh ends a question too when it gives a link up."""
        began = self._clock()
        try:
            answered = self._ask(LONGEST)
        except RuntimeError:  # the session is being closed
            return
        if answered and not self._silent:
            now = self._clock()
            self.state = replace(self.state, heard=now, delay=now - began)
        self._silent = not answered
