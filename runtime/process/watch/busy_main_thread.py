"""Detect that this process's main thread computes without ever waiting, so that its node receives nothing."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable

from .. import stack_frames, unpatched
from .processor_time import ran_and_waited

PERIOD_S = 0.5
"""Wall time (s) between two checks."""
WANTED_SHARE = 0.9
"""Share of wall time spent running or waiting for a processor from which on a thread counts as computing."""
REPORT_S = 1.0
"""Processor time (s) without a wait after which a thread is reported; on a busy machine a start may take seconds."""


class MainWatch:
    """Reports in which line the main thread computes, once each time it begins, if the system tells such times."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._computed = 0.0
        self._before = (0.0, 0.0, 0.0)

    def begin(self) -> None:
        """Start watching until the process ends; call it in the main thread."""
        if self._times() is not None:
            self._before = (unpatched.monotonic(), *(self._times() or (0.0, 0.0)))
            unpatched.later(PERIOD_S, self._poll)

    @staticmethod
    def _times() -> tuple[float, float] | None:
        return ran_and_waited(f"self/task/{os.getpid()}")  # the main thread's id is the process's

    def _poll(self) -> None:
        then, ran_then, waited_then = self._before
        self._before = (unpatched.monotonic(), *(self._times() or (0.0, 0.0)))
        now, ran, waited = self._before
        main = threading.main_thread().ident or 0
        wanted = ran - ran_then + waited - waited_then
        if wanted < WANTED_SHARE * (now - then) or stack_frames.is_importing(main):
            self._computed = 0.0
        else:
            before, self._computed = self._computed, self._computed + ran - ran_then
            if before < REPORT_S <= self._computed:
                self._report(
                    f"has computed for {REPORT_S:g} s without waiting, in {stack_frames.thread_line(main)}. It hears "
                    "nothing meanwhile: let it spin, sleep or wait in its loop"
                )
        unpatched.later(PERIOD_S, self._poll)
