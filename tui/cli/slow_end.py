"""Tells whoever quits a console why it has not ended yet."""

from __future__ import annotations

import contextlib
import sys
import threading
from collections.abc import Generator

SOON = 1.0
"""Seconds an end may take without a word."""
WAITING = "waiting for what was launched to end; it is killed after 10 s"


@contextlib.contextmanager
def slow_end_told(soon: float = SOON) -> Generator[None]:
    """Print one line to the terminal if the block takes longer than `soon` (s).

    The screen has gone by then, and a program whose thread never ends keeps its launch waiting for 10 s.
    """
    timer = threading.Timer(soon, _tell)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def _tell() -> None:
    with contextlib.suppress(OSError, ValueError):  # the terminal has gone
        if sys.__stderr__ is not None and sys.__stderr__.isatty():
            print(WAITING, file=sys.__stderr__, flush=True)
