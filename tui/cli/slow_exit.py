"""Reports why a console takes long to end after it was quit."""

from __future__ import annotations

import contextlib
import sys
import threading
from collections.abc import Generator

QUIET_EXIT_S = 1.0
"""Seconds that the shutdown may take without a message."""
WAITING_TEXT = "waiting for launched programs to end; they are killed after 10 s"


@contextlib.contextmanager
def report_slow_exit(soon: float = QUIET_EXIT_S) -> Generator[None]:
    """Print one line to the terminal if the block takes longer than `soon` (s).

    The screen is gone by then, and a launched program whose thread never ends delays the end of its launch by 10 s.
    """
    timer = threading.Timer(soon, _report)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def _report() -> None:
    with contextlib.suppress(OSError, ValueError):  # the terminal is gone
        if sys.__stderr__ is not None and sys.__stderr__.isatty():
            print(WAITING_TEXT, file=sys.__stderr__, flush=True)
