"""Interpreter settings while a screen is being built and shown."""

from __future__ import annotations

import contextlib
import gc
import sys
from collections.abc import Generator

SWITCH_INTERVAL_S = 0.0005
"""Seconds after which a busy node must let the screen's thread run; Python's 5 ms make keys feel slow."""


@contextlib.contextmanager
def without_collector() -> Generator[None]:
    """Switch the garbage collector off until `resume_collection` is called or the block ends.

    The modules and objects of the screen stay alive, and traversing them repeatedly would delay the first frame and the
    first keys by tens of milliseconds each time.
    """
    gc.disable()
    try:
        yield
    finally:
        resume_collection()  # otherwise the shutdown would first traverse everything made so far


def resume_collection() -> None:
    """Switch the garbage collector on again, ignoring everything that exists by now."""
    gc.freeze()
    gc.enable()


@contextlib.contextmanager
def eager_switching() -> Generator[None]:
    """Let the screen's thread run promptly while other threads are busy."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    try:
        yield
    finally:
        sys.setswitchinterval(before)
