"""Ctrl-C while a launch runs."""

from __future__ import annotations

import asyncio
import signal
import threading
from collections.abc import Callable
from typing import Any


class UserInterrupt:
    """Calls back in the loop on each SIGINT, with whether it is a repeated one. Does nothing off the main thread."""

    def __init__(self, callback: Callable[[bool], None]) -> None:
        self._callback = callback
        self._before: Any = None
        self._count = 0

    def __enter__(self) -> UserInterrupt:
        self._loop = asyncio.get_running_loop()
        self._active = threading.current_thread() is threading.main_thread()
        if self._active:
            self._before = signal.signal(signal.SIGINT, self._on_sigint)
        return self

    def __exit__(self, *_details: object) -> None:
        # If the launch was killed, this runs whenever its coroutine is collected: in any thread, possibly one of
        # another node process with its own handler.
        if self._active and signal.getsignal(signal.SIGINT) == self._on_sigint:
            signal.signal(signal.SIGINT, self._before)

    def _on_sigint(self, _signum: int, _frame: object) -> None:
        self._count += 1
        self._loop.call_soon_threadsafe(self._callback, self._count > 1)
