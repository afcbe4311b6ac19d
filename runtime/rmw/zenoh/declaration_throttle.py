"""Throttles a process that declares many entities at once, as every process of the domain must handle each of them."""

from __future__ import annotations

import time
from collections.abc import Callable

AT_ONCE = 1000
"""Number of declarations made without a pause: about fifty nodes."""
DECLARATIONS_PER_PAUSE = 20
"""Number of declarations between two pauses."""
PAUSE_S = 0.005
"""Length of a pause, in seconds: as long as the declarations in between, which leaves half a processor to others."""
QUIET_S = 0.1
"""Time without declarations, in seconds, after which `AT_ONCE` of them may again be made without a pause."""


class DeclarationThrottle:
    """Counts declarations, and pauses regularly once there are very many."""

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        self._clock = clock
        self._sleep = sleep
        self._count = 0
        self._last = 0.0

    def count_declaration(self) -> None:
        """Count a declaration, and pause if one is due."""
        now = self._clock()
        self._count = self._count + 1 if now - self._last < QUIET_S else 1
        if self._count > AT_ONCE and self._count % DECLARATIONS_PER_PAUSE == 0:
            self._sleep(PAUSE_S)
        self._last = self._clock()
