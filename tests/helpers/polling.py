"""Waits for conditions: a test never waits without a timeout, and its failure says what did not happen."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TypeVar

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; the tests measure no time."""

T = TypeVar("T")


def until(
    condition: Callable[[], T],
    what: str | Callable[[], object] = "it",
    *,
    step: Callable[[], object] = lambda: None,
    poll_s: float = 0.002,
    timeout_s: float = TIMEOUT_S,
) -> T:
    """Repeat `step` until a condition holds, and return its value; fail with `what` after the timeout."""
    deadline, pause = time.monotonic() + timeout_s, threading.Event()
    while not (found := condition()):
        assert time.monotonic() < deadline, f"waited in vain for {what}" if isinstance(what, str) else what()
        step()
        pause.wait(poll_s)
    return found
