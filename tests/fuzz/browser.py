"""Data that browsers send to `bot-console serve`: each function feeds a text to the server, or to an open console."""

from __future__ import annotations

import asyncio
import os
import pty
import select
import socket
import threading
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from types import SimpleNamespace
from typing import Any, cast

TOKEN, COOKIE = "t0ken", "c00kie"
WAIT_S = 240.0
"""Timeout in seconds for an answer; it only ends a server that hangs."""
ANSWER_S = 0.05
"""Seconds after which a request without an answer counts as unfinished."""


def http(text: str) -> None:
    """The bytes of a connection; whatever they are, the server answers without an internal error."""
    server, port, faults = served("true")
    server._admissions[0].token = TOKEN
    data = text.replace("PORT", str(port)).encode("utf-8", "surrogatepass")
    with socket.create_connection(("127.0.0.1", port), WAIT_S) as link, suppress(ConnectionError):
        link.sendall(data)
        if not select.select([link], [], [], ANSWER_S)[0]:
            link.shutdown(socket.SHUT_WR)  # the server waits for more
        if select.select([link], [], [], ANSWER_S)[0]:
            link.recv(4096)
    assert not faults, faults.pop()


def http_seeds() -> Sequence[str]:
    host = "Host: 127.0.0.1:PORT\r\n"
    cookie = f"Cookie: bot-console-PORT={COOKIE}\r\n"
    upgrade = (
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nOrigin: http://127.0.0.1:PORT\r\n"
    )
    return (
        f"GET / HTTP/1.1\r\n{host}{cookie}\r\n",
        f"GET /?token={TOKEN} HTTP/1.1\r\n{host}\r\n",
        f"GET /?token=%C3%A4&x=1 HTTP/1.1\r\n{host}Cookie: bot-console-PORT=ä\r\n\r\n",
        f"GET /static/page.css HTTP/1.1\r\n{host}{cookie}Range: bytes=0-9\r\n\r\n",
        f"GET /ws?width=80&height=24 HTTP/1.1\r\n{host}{cookie}{upgrade}\r\n\x81\x05hello",
    )


def admit(server: Any) -> None:
    """Make room for a browser, whatever connections earlier ones still have open."""
    from bot_console.tui.cli.serve.server import Admission

    server._admissions = [Admission(token=TOKEN, cookie=COOKIE)]


@cache
def served(console: str) -> tuple[Any, int, list[str]]:
    """A server of a console on loopback, which runs until the program ends; its port and its log of internal errors."""
    from aiohttp import web
    from bot_console.tui.cli.serve.server import Server

    server = Server([console], "127.0.0.1")
    ready: list[int] = []
    faults: list[str] = []

    def fault(text: str, *values: object, exc_info: Any = None, **_: object) -> None:
        if "400, message" not in str(exc_info):  # refused requests
            faults.append(f"{text % values}: {exc_info}")

    log = cast(Any, SimpleNamespace(debug=lambda *_, **__: None, error=fault, exception=fault, warning=fault))
    known = threading.Event()

    async def serve() -> None:
        runner = web.AppRunner(server.application(), access_log=None, logger=log)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        server.addresses(runner.addresses[0][1])
        admit(server)
        ready.append(runner.addresses[0][1])
        known.set()
        while True:
            await asyncio.sleep(WAIT_S)

    threading.Thread(target=lambda: asyncio.run(serve()), daemon=True).start()
    assert known.wait(WAIT_S)
    return server, ready[0], faults


class _Input:
    """A console's input that nobody reads."""

    def write(self, data: bytes) -> None:
        assert isinstance(data, bytes)


def page_message(text: str) -> None:
    """A message of the page."""
    _terminal()._handle(text, cast(Any, _Input()))


@cache
def _terminal() -> Any:
    from bot_console.tui.cli.serve.terminal import Terminal

    terminal = cast(Any, object.__new__(Terminal))
    terminal._master, _ = pty.openpty()
    reader, terminal._alive = os.pipe()
    os.close(reader)
    return terminal
