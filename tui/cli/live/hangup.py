"""Notices that the terminal has gone where no signal tells it, as under some supervisors and after a lost session."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import threading
from collections.abc import Generator

LOOK_MS = 1000


@contextlib.contextmanager
def hangup_as_signal() -> Generator[None]:
    """Raise SIGHUP in this process when the terminal on standard input hangs up."""
    over = threading.Event()
    terminal = (sys.__stdin__ or sys.stdin).fileno()
    threading.Thread(target=_watch, args=(terminal, over), name="hang-up", daemon=True).start()
    try:
        yield
    finally:
        over.set()


def _watch(terminal: int, over: threading.Event) -> None:
    poller = select.poll()
    poller.register(terminal, 0)  # a hang-up is reported without being asked for
    while not over.is_set():
        with contextlib.suppress(InterruptedError):
            if poller.poll(LOOK_MS) and not over.is_set():
                os.kill(os.getpid(), signal.SIGHUP)
                return
