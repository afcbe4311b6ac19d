"""What a launch knows of a process that it has started."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Protocol

Output = Callable[[int, bytes], None]
"""Called in the launch's loop with 1 (stdout) or 2 (stderr) and the bytes that came."""


class Child(Protocol):
    """A process that was started."""

    pid: int
    exited: asyncio.Future[int]
    """The exit code, when it has ended and all it has printed was handed on."""
    gets_signals_of_terminal: bool
    """Whether Ctrl-C reaches it without the launch."""

    def send_signal(self, signum: int) -> None:
        """Deliver a signal; raises `TypeError` for anything but a number."""
        ...

    def write(self, data: bytes) -> None:
        """Hand bytes to its standard input."""
        ...

    def close(self) -> None:
        """Let go of everything that belongs to it."""
        ...
