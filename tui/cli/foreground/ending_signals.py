"""The signals that end a console, and how a terminal that vanishes without one (under some supervisors) is noticed."""

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
"""Signals that end a console in order."""

SIGNAL_POLL_MS = 1000
END_TIMEOUT_S = 1.0
"""How long what a signal has begun is waited for when the console has ended, in s."""


@contextlib.contextmanager
def ended_by_signals(end: Callable[[int], None]) -> Generator[None]:
    """Call `end` with the number of each signal that ends a console, in a thread of its own.

    Ending needs locks, for the robot is stopped first, and the thread that a signal interrupts may hold any of them at
    that moment; another signal may come in the midst of it, too.
    """
    reading, writing = os.pipe()
    os.set_blocking(writing, False)

    def serve() -> None:
        # The former where a program of the person's own has closed all descriptors, the latter where the app has ended.
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
    poller.register(terminal, 0)  # a hang-up is reported without being asked for
    while not over.is_set():
        with contextlib.suppress(InterruptedError):
            if poller.poll(SIGNAL_POLL_MS) and not over.is_set():
                os.kill(os.getpid(), signal.SIGHUP)
                return
