"""Notices that the main thread of this process computes without ever waiting: its node hears nothing meanwhile."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable

from .. import frames, real
from .processor_time import wanted_seconds

PERIOD_S = 2.0
"""Wall time (s) between two looks."""
WANTED_SHARE = 0.9
"""The share of wall time from which a thread that ran, or waited for a processor and for nothing else, is told."""
LOOKS = 3


class MainWatch:
    """Tells once, each time it begins, in which line the main thread computes; where the system tells such times."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell
        self._looks = 0
        self._before = (0.0, 0.0)

    def begin(self) -> None:
        """Look from now on, for as long as the process lives; to be called in the main thread."""
        if self._wanted() is not None:
            self._before = (real.monotonic(), self._wanted() or 0.0)
            real.later(PERIOD_S, self._look)

    @staticmethod
    def _wanted() -> float | None:
        return wanted_seconds(f"self/task/{os.getpid()}")  # the main thread has the process's id

    def _look(self) -> None:
        now, wanted = real.monotonic(), self._wanted() or 0.0
        (then, wanted_then), self._before = self._before, (now, wanted)
        self._looks = self._looks + 1 if wanted - wanted_then >= WANTED_SHARE * (now - then) else 0
        if self._looks == LOOKS:
            line = frames.thread_line(threading.main_thread().ident or 0)
            self._tell(
                f"has computed for {LOOKS * PERIOD_S:g} s without waiting, in {line}. It hears nothing meanwhile: "
                "let it spin, sleep or wait in its loop"
            )
        real.later(PERIOD_S, self._look)
