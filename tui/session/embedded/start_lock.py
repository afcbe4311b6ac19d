"""Lets only one background system start at a time: checking, starting and recording it are a single step."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from collections.abc import Generator
from pathlib import Path
from types import FrameType

from bot_console.runtime.rmw.zenoh.domain.file_lock import open_lock, try_lock

LOCK_POLL_S = 0.02
"""Seconds between two checks whether the other start has finished."""
SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


@contextlib.contextmanager
def start_lock(lock: Path, timeout_s: float) -> Generator[bool]:
    """Hold the lock, and hold back the signals that would end this process, for the length of a `with` block.

    Yields whether the lock was acquired within `timeout_s`. Signals take effect after the block: if one ended this
    process inside it, a system could be running that is not recorded, so that nobody could end it.
    """
    handle = open_lock(lock)
    try:
        deadline = time.monotonic() + timeout_s
        while not (got := try_lock(handle)) and time.monotonic() < deadline:
            time.sleep(LOCK_POLL_S)
        with _signals_held_back():
            yield got
    finally:
        os.close(handle)


@contextlib.contextmanager
def _signals_held_back() -> Generator[None]:
    """Hold signals back with handlers, because a program that is started meanwhile would inherit a mask."""
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
