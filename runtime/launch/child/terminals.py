"""Terminals that a child prints to, so that it behaves as if a person looked on."""

from __future__ import annotations

import asyncio
import os
import pty
import termios
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Terminal:
    """Both ends of a pseudo terminal."""

    own_end: int
    child_end: int

    async def connect(self, loop: asyncio.AbstractEventLoop, child: Any, fd: int) -> asyncio.ReadTransport:
        """Hand what comes to a child's protocol, as its stdout (1) or stderr (2)."""
        pipe = os.fdopen(self.own_end, "rb", buffering=0)
        transport, _ = await loop.connect_read_pipe(lambda: _Reader(child, fd), pipe)
        return transport


class _Reader(asyncio.Protocol):
    def __init__(self, child: Any, fd: int) -> None:
        self._child = child
        self._fd = fd

    def data_received(self, data: bytes) -> None:
        self._child.pipe_data_received(self._fd, data)

    def connection_lost(self, exc: Exception | None) -> None:
        self._child.pipe_connection_lost(self._fd, exc)


def open_terminals() -> tuple[Terminal, Terminal]:
    """One for stdout, one for stderr; they leave line ends as they are."""
    return _open(), _open()


def _open() -> Terminal:
    own_end, child_end = pty.openpty()
    settings = termios.tcgetattr(child_end)
    settings[1] &= ~termios.ONLCR
    termios.tcsetattr(child_end, termios.TCSANOW, settings)
    return Terminal(own_end, child_end)
