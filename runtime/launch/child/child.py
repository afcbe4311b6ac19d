"""A launch's interface to a process that it has started."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Protocol

Output = Callable[[int, bytes], None]
"""Called in the launch's event loop with 1 (stdout) or 2 (stderr) and the received bytes."""


class Child(Protocol):
    """A started process."""

    pid: int
    exited: asyncio.Future[int]
    """The exit code; set when the process has ended and all of its output was passed on."""
    gets_signals_of_terminal: bool
    """Whether Ctrl-C in the terminal reaches the process without the launch."""

    def send_signal(self, signum: int) -> None:
        """Deliver a signal; raises `TypeError` for anything but a number."""
        ...

    def write(self, data: bytes) -> None:
        """Write bytes to the process's standard input."""
        ...

    def close(self) -> None:
        """Release all resources."""
        ...
