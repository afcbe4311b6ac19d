"""Handles signals that end a console, and detects a terminal that vanishes without one (under some supervisors)."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import threading
from collections.abc import Callable, Generator
from types import FrameType

ENDING = [getattr(signal, each) for each in ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT") if hasattr(signal, each)]
"""The signals on which a console shuts down in order."""

SIGNAL_POLL_MS = 1000
END_TIMEOUT_S = 1.0
"""Seconds to wait, after the console has ended, for the thread that handles a signal."""


@contextlib.contextmanager
def ended_by_signals(end: Callable[[int], None]) -> Generator[None]:
    """Call `end` in a separate thread with the number of each signal that ends a console.

    Ending needs locks, because the robot is stopped first. A signal handler must not wait for them: the interrupted
    thread may hold any of them, and another signal may arrive meanwhile.
    """
    reading, writing = os.pipe()
    os.set_blocking(writing, False)

    def serve() -> None:
        # OSError if a user's program has closed all descriptors, RuntimeError if the app has ended.
        with contextlib.suppress(OSError, RuntimeError):
            while number := os.read(reading, 1):
                end(number[0])

    thread = threading.Thread(target=serve, name="ending", daemon=True)
    thread.start()

    def note(number: int, frame: FrameType | None) -> None:
        try:
            if thread.is_alive():
                os.write(writing, bytes([number]))
                return
        except OSError:
            pass
        with contextlib.suppress(RuntimeError):
            end(number)

    before = {each: signal.signal(each, note) for each in ENDING}
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)
        with contextlib.suppress(OSError):
            os.close(writing)
        thread.join(END_TIMEOUT_S)
        with contextlib.suppress(OSError):
            os.close(reading)


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
    poller.register(terminal, 0)  # `poll` reports a hang-up without being asked to
    while not over.is_set():
        with contextlib.suppress(InterruptedError):
            if poller.poll(SIGNAL_POLL_MS) and not over.is_set():
                os.kill(os.getpid(), signal.SIGHUP)
                return
