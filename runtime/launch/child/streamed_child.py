"""A process whose output arrives through pipes or terminals: it has ended once exit code and all output are here."""

from __future__ import annotations

import asyncio
import os

from launch.child.child import Output

DRAIN_S = 0.2
"""How long (s) output may still come after the end: a grandchild can hold the pipes open for ever."""


class StreamedChild:
    """Collects what a process prints and how it ended."""

    def __init__(self, output: Output, loop: asyncio.AbstractEventLoop) -> None:
        self._output = output
        self._loop = loop
        self.exited: asyncio.Future[int] = loop.create_future()
        self.open_streams = {1, 2}
        self._code: int | None = None

    def pipe_data_received(self, fd: int, data: bytes) -> None:
        """It has printed."""
        self._output(fd, bytes(data))

    def pipe_connection_lost(self, fd: int, exc: Exception | None) -> None:
        """It prints no more."""
        self.open_streams.discard(fd)
        self._finish_if_drained()

    def has_ended(self, code: int) -> None:
        """It has ended with this exit code; its output may still come."""
        self._code = code
        self._finish_if_drained()
        if not self.exited.done():
            self._loop.call_later(DRAIN_S, self._finish)

    def _finish_if_drained(self) -> None:
        if self._code is not None and not self.open_streams:
            self._finish()

    def _finish(self) -> None:
        if not self.exited.done():
            self.exited.set_result(self._code or 0)


class StreamReader(asyncio.Protocol):
    """Hands what comes from a descriptor to a child, as its stdout (1) or stderr (2)."""

    def __init__(self, child: StreamedChild, fd: int) -> None:
        self._child = child
        self._fd = fd

    def data_received(self, data: bytes) -> None:
        """It has printed."""
        self._child.pipe_data_received(self._fd, data)

    def connection_lost(self, exc: Exception | None) -> None:
        """It prints no more."""
        self._child.pipe_connection_lost(self._fd, exc)


async def read_stream(child: StreamedChild, fd: int, own_end: int) -> asyncio.ReadTransport:
    """Let a child have what comes from our end of a pipe or terminal, which belongs to the transport from now on."""
    pipe = os.fdopen(own_end, "rb", buffering=0)
    transport, _ = await asyncio.get_running_loop().connect_read_pipe(lambda: StreamReader(child, fd), pipe)
    return transport
