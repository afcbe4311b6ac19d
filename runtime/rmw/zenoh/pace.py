"""Pauses for a process that declares many things at once: every process of the domain has to take in each of them."""

from __future__ import annotations

import time
from collections.abc import Callable

AT_ONCE = 1000
"""Things that are shown without a rest: some fifty nodes."""
EACH = 20
"""Things between two rests."""
REST = 0.005
"""Seconds of a rest: as long as making so many things takes, so that others have half of a processor."""
QUIET = 0.1
"""Seconds without a new thing after which as many may come at once again."""


class Pace:
    """Counts what is shown, and rests now and then where that is very much."""

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        self._clock = clock
        self._sleep = sleep
        self._count = 0
        self._last = 0.0

    def shown(self) -> None:
        """One more thing is shown."""
        now = self._clock()
        self._count = self._count + 1 if now - self._last < QUIET else 1
        if self._count > AT_ONCE and self._count % EACH == 0:
            self._sleep(REST)
        self._last = self._clock()
