"""A pilot's rest: when the app has nothing left to do, known from its event loop and not from a clock alone.

Textual's pilot takes a process for idle that used next to no processor time for 20 ms; beside others a process uses
none because it gets none, with keys still on their way.
"""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

from textual import _wait
from textual import app as app_module
from textual import pilot as pilot_module
from textual._context import active_app

LOOKS = 100_000
"""Turns of the event loop after which what never rests is left alone."""


async def rest(min_sleep: float = 0.02, max_sleep: float = 1) -> None:
    """Wait until nothing is left to run or to draw, also when threads and timers have had their time."""
    await _drained()
    await _wait.wait_for_idle(min_sleep, max_sleep)
    await _drained()


async def _drained() -> None:
    loop: Any = asyncio.get_running_loop()
    app = active_app.get(None)
    for _ in range(LOOKS):
        await asyncio.sleep(0)
        if loop._ready:
            continue
        if app is not None and app.screen_stack and app.screen.is_running:
            app.screen._on_timer_update()  # what would be drawn when the next frame is due
        if not loop._ready:
            return


@contextmanager
def at_rest() -> Iterator[None]:
    """Pilots wait so, meanwhile."""
    with patch.object(app_module, "wait_for_idle", rest), patch.object(pilot_module, "wait_for_idle", rest):
        yield
