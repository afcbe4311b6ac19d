"""Throttles a process that declares many entities at once, as every process of the domain must take in each."""

from __future__ import annotations

import time
from collections.abc import Callable

AT_ONCE = 1000
"""Declarations made without a pause: about fifty nodes."""
DECLARATIONS_PER_PAUSE = 20
"""Declarations between two pauses."""
PAUSE_S = 0.005
"""Length of a pause, in seconds: as long as the declarations between two take, which leaves half of a processor to
others.
"""
QUIET_S = 0.1
"""Seconds without a declaration after which `AT_ONCE` may be made without a pause again."""


class Pace:
    """Counts declarations and pauses now and then when there are very many."""

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        self._clock = clock
        self._sleep = sleep
        self._count = 0
        self._last = 0.0

    def shown(self) -> None:
        """Count a declaration, and pause if one is due."""
        now = self._clock()
        self._count = self._count + 1 if now - self._last < QUIET_S else 1
        if self._count > AT_ONCE and self._count % DECLARATIONS_PER_PAUSE == 0:
            self._sleep(PAUSE_S)
        self._last = self._clock()
