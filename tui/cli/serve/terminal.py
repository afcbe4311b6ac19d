"""A console in a pseudo-terminal that a browser shows; the terminal is closed when the browser is gone."""

from __future__ import annotations

import asyncio
import contextlib
import fcntl
import json
import os
import pty
import struct
import subprocess
import termios
from collections.abc import Mapping, Sequence
from typing import Any, cast

from aiohttp import WSMsgType, web
from bot_console.tui.cli.foreground.browser_watch import VARIABLE

CHUNK_BYTES = 65_536
MAX_UNREAD_BYTES = 1_000_000
"""Bytes of input that the console has not read, beyond which the browser is disconnected."""
END_TIMEOUT_S = 10.0
"""Seconds that a console may take to stop its robot and end."""
MAX_CELLS = 1000
TERMINAL_VARIABLES = ("COLUMNS", "LINES", "STY", "TERM_PROGRAM", "TERM_PROGRAM_VERSION", "TMUX", "TMUX_PANE")
"""Environment variables that describe the terminal in which the server was started."""


class Terminal:
    """Starts the console at once; `show` connects a browser to it, `close` hangs up."""

    def __init__(self, command: Sequence[str], size: tuple[int, int]) -> None:
        """Start `command` in a terminal of `size` (columns, rows)."""
        self._master, slave = pty.openpty()
        self._set_size(*size)
        alive, self._alive = os.pipe()
        os.set_blocking(self._alive, False)
        kept = {name: value for name, value in os.environ.items() if name not in TERMINAL_VARIABLES}
        environment = {**kept, "TERM": "xterm-256color", "COLORTERM": "truecolor", VARIABLE: str(alive)}
        try:
            self._process = subprocess.Popen(
                command, stdin=slave, stdout=slave, stderr=slave, env=environment, start_new_session=True,
                pass_fds=[alive], preexec_fn=_take_terminal,  # noqa: PLW1509 -- it calls the system, and takes no lock
            )  # fmt: skip
        finally:
            os.close(slave)
            os.close(alive)
        self._writer: asyncio.WriteTransport | None = None
        self._closing: asyncio.Task[None] | None = None

    async def show(self, socket: web.WebSocketResponse) -> None:
        """Pass output to a browser and its input back, until one of the two ends."""
        tasks = [asyncio.ensure_future(each) for each in (self._send(socket), self._receive(socket))]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for each in tasks:
                each.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            with contextlib.suppress(ConnectionError, asyncio.TimeoutError):
                await socket.close()

    async def _send(self, socket: web.WebSocketResponse) -> None:
        reader = asyncio.StreamReader(CHUNK_BYTES)
        loop = asyncio.get_running_loop()
        output = os.fdopen(os.dup(self._master), "rb", 0)
        transport, _ = await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), output)
        try:
            while data := await reader.read(CHUNK_BYTES):
                await socket.send_bytes(data)  # waits for a slow browser, so that the console waits for its terminal
        except (OSError, ConnectionError):
            pass
        finally:
            transport.close()

    async def _receive(self, socket: web.WebSocketResponse) -> None:
        loop = asyncio.get_running_loop()
        place = os.fdopen(os.dup(self._master), "wb", 0)
        transport, _ = await loop.connect_write_pipe(asyncio.BaseProtocol, place)
        try:
            async for message in socket:
                if message.type is not WSMsgType.TEXT:
                    break
                self._handle(message.data, transport)
                if transport.get_write_buffer_size() > MAX_UNREAD_BYTES:
                    break
        finally:
            transport.abort()

    def _handle(self, text: str, transport: asyncio.WriteTransport) -> None:
        """Act on a message of the page; invalid messages are ignored."""
        try:
            message: Any = json.loads(text)
        except (ValueError, RecursionError):
            return
        if not isinstance(message, list) or not message:
            return
        kind, *rest = cast("list[Any]", message)
        if kind == "alive":
            with contextlib.suppress(BlockingIOError, BrokenPipeError):
                os.write(self._alive, b".")
        elif kind == "stdin" and rest and isinstance(rest[0], str):
            transport.write(rest[0].encode("utf-8", "replace"))
        elif kind == "resize" and rest and isinstance(rest[0], Mapping):
            size = cast("Mapping[str, Any]", rest[0])
            self._set_size(size.get("width"), size.get("height"))

    def _set_size(self, width: Any, height: Any) -> None:
        if all(isinstance(each, int) and 0 < each <= MAX_CELLS for each in (width, height)):
            fcntl.ioctl(self._master, termios.TIOCSWINSZ, struct.pack("HHHH", height, width, 0, 0))

    async def close(self) -> None:
        """Hang up, and wait until the console has ended; a second call waits for the first."""
        if self._closing is None:
            self._closing = asyncio.ensure_future(self._close())
        await asyncio.shield(self._closing)

    async def _close(self) -> None:
        os.close(self._master)  # makes the kernel send SIGHUP to the console
        os.close(self._alive)
        loop = asyncio.get_running_loop()
        try:
            await loop.run_in_executor(None, self._process.wait, END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            await loop.run_in_executor(None, self._process.wait)


def _take_terminal() -> None:
    """Make standard input the controlling terminal of the new session."""
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
