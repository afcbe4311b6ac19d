"""How the interpreter is set while a screen is made and shown."""

from __future__ import annotations

import contextlib
import gc
import sys
from collections.abc import Generator

SWITCH_INTERVAL = 0.0005
"""Seconds after which a busy node must let the screen's thread run; Python's 5 ms make keys feel slow."""


@contextlib.contextmanager
def without_collector() -> Generator[None]:
    """Look for no garbage until `collect_from_now_on`, or the end.

    What is imported and made for the screen stays: to look it through again and again holds up the first frame and
    the first keys, by tens of milliseconds at a time.
    """
    gc.disable()
    try:
        yield
    finally:
        collect_from_now_on()  # else the end would begin with a look through all that was made up to now


def collect_from_now_on() -> None:
    """Look for garbage again, but not among what there is now."""
    gc.freeze()
    gc.enable()


@contextlib.contextmanager
def eager_switching() -> Generator[None]:
    """Let the screen's thread run soon while others are busy."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL)
    try:
        yield
    finally:
        sys.setswitchinterval(before)
