"""One start of a background system at a time: what looks whether one runs, starts it and writes it down is one step."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from collections.abc import Generator
from pathlib import Path
from types import FrameType

from bot_console.runtime.rmw.zenoh.domain.file_lock import open_lock, try_lock

POLL = 0.02
"""Seconds between two looks whether the other start is done."""
SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


@contextlib.contextmanager
def start_lock(lock: Path, timeout_s: float) -> Generator[bool]:
    """Hold the lock, and the signals that would end this process, for the length of a `with` block.

    Gives whether the lock was got in so many seconds. A signal takes effect behind the block: amid it, a system could
    run that nobody has written down, so that nobody could end it.
    """
    handle = open_lock(lock)
    try:
        deadline = time.monotonic() + timeout_s
        while not (got := try_lock(handle)) and time.monotonic() < deadline:
            time.sleep(POLL)
        with _signals_held_back():
            yield got
    finally:
        os.close(handle)


@contextlib.contextmanager
def _signals_held_back() -> Generator[None]:
    """By handlers and not by a mask, which a program that is started meanwhile would inherit."""
    came: list[int] = []

    def keep(number: int, frame: FrameType | None) -> None:
        came.append(number)

    before = {each: signal.signal(each, keep) for each in SIGNALS if signal.getsignal(each) != signal.SIG_IGN}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])
