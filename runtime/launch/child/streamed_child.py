"""A process whose output is read from pipes or terminals; it has ended once its exit code and all output are in."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable
from functools import partial

from launch.child.child import Output

DRAIN_S = 0.2
"""How long (s) output is awaited after the exit, as a grandchild may hold the pipes open for ever."""


class StreamedChild:
    """Collects a process's output and exit code."""

    def __init__(self, output: Output, loop: asyncio.AbstractEventLoop) -> None:
        self._output = output
        self._loop = loop
        self.exited: asyncio.Future[int] = loop.create_future()
        self.open_streams = {1, 2}
        self._code: int | None = None

    def pipe_data_received(self, fd: int, data: bytes) -> None:
        """Pass on output."""
        self._output(fd, bytes(data))

    def pipe_connection_lost(self, fd: int, exc: Exception | None) -> None:
        """Handle the end of a stream."""
        self.open_streams.discard(fd)
        self._finish_if_drained()

    def on_exit(self, code: int) -> None:
        """Record the exit code; output may still arrive."""
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
    """Passes on the data read from a descriptor, and its end."""

    def __init__(self, take: Callable[[bytes], None], end: Callable[[], None]) -> None:
        self._take = take
        self._end = end

    def data_received(self, data: bytes) -> None:
        """Pass on data."""
        self._take(data)

    def connection_lost(self, exc: Exception | None) -> None:
        """Handle the end of the stream."""
        self._end()


async def read_stream(descriptor: int, take: Callable[[bytes], None], end: Callable[[], None]) -> asyncio.ReadTransport:
    """Read a descriptor, which the returned transport owns from now on."""
    pipe = os.fdopen(descriptor, "rb", buffering=0)
    transport, _ = await asyncio.get_running_loop().connect_read_pipe(lambda: StreamReader(take, end), pipe)
    return transport


async def read_output(child: StreamedChild, fd: int, own_end: int) -> asyncio.ReadTransport:
    """Read a child's stdout (1) or stderr (2) from our end of a pipe or terminal."""
    return await read_stream(
        own_end, partial(child.pipe_data_received, fd), partial(child.pipe_connection_lost, fd, None)
    )
