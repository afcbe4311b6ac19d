"""Access to `bot-console serve`: token, cookie, Host and Origin; what the page loads; how a session ends."""

from __future__ import annotations

import asyncio
import json
import re
import sys
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any

import pytest
from aiohttp import ClientSession, CookieJar, WSServerHandshakeError, web
from bot_console.tui.cli.main import main
from bot_console.tui.cli.serve.server import Server, one_line_log

CONSOLE = """
import os, shutil, signal, sys, tty
signal.signal(signal.SIGHUP, lambda number, frame: os._exit(0))
tty.setraw(0)
while True:
    print("size", *shutil.get_terminal_size(), "controls", os.tcgetpgrp(0) == os.getpgrp(), end=".", flush=True)
    print("read", os.read(0, 100), end=".", flush=True)
"""
WATCHING = """
import os
while True:
    print("alive", os.read(int(os.environ["BOT_CONSOLE_BROWSER"]), 1), end=".", flush=True)
"""


@asynccontextmanager
async def served(sessions: int = 1, console: str = CONSOLE) -> AsyncIterator[tuple[Server, list[str], int]]:
    server = Server([sys.executable, "-c", console], "127.0.0.1", sessions=sessions)
    runner = web.AppRunner(server.application(), shutdown_timeout=0.1)
    await runner.setup()
    try:
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        port = runner.addresses[0][1]
        yield server, server.addresses(port), port
    finally:
        await runner.cleanup()


def a_browser() -> ClientSession:
    return ClientSession(cookie_jar=CookieJar(unsafe=True))


async def status(session: ClientSession, address: str, **headers: str) -> int:
    async with session.get(address, headers=headers, allow_redirects=False) as answer:
        return answer.status


async def socket_status(session: ClientSession, port: int, **headers: str) -> int:
    try:
        async with session.ws_connect(f"http://127.0.0.1:{port}/ws", headers=headers):
            return 101
    except WSServerHandshakeError as error:
        return error.status


def run(work: Callable[[], Awaitable[Any]]) -> None:
    asyncio.run(asyncio.wait_for(work(), 60))  # type: ignore[arg-type]


def test_token_is_exchanged_once_for_a_cookie_that_no_script_reads() -> None:
    async def work() -> None:
        async with served() as (_, [address], port), a_browser() as first, a_browser() as second:
            assert await status(first, f"http://127.0.0.1:{port}/?token=wrong") == 403
            async with first.get(address, allow_redirects=False) as answer:
                assert (answer.status, answer.headers["Location"]) == (303, "/")
                cookie = answer.headers["Set-Cookie"]
            assert "HttpOnly" in cookie and "SameSite=Strict" in cookie and "token" not in cookie
            assert await status(first, f"http://127.0.0.1:{port}/") == 200
            assert await status(first, address) == 303, "the same browser may use its link again"
            assert await status(second, address) == 403
            assert await status(second, f"http://127.0.0.1:{port}/") == 403

    run(work)


def test_nothing_is_served_without_a_cookie() -> None:
    async def work() -> None:
        async with served() as (_, _, port), a_browser() as session:
            for path in ("", "static/page.js", "static/textual.js", "ws", "static/..%2f..%2frun.py", "other"):
                assert await status(session, f"http://127.0.0.1:{port}/{path}", Origin=f"http://127.0.0.1:{port}") in (
                    403,
                    404,
                ), path
            assert await socket_status(session, port, Origin=f"http://127.0.0.1:{port}") == 403

    run(work)


def test_foreign_hosts_and_origins_are_refused() -> None:
    async def work() -> None:
        async with served() as (_, [address], port), a_browser() as session:
            here = f"http://127.0.0.1:{port}"
            await status(session, address)
            assert await status(session, here, Host="robot.example:8000") == 403
            assert await status(session, here, Host="localhost.example") == 403
            assert await status(session, here, Host="localhost:9000") == 200, "the near end of a tunnel"
            assert await status(session, here, Origin="http://localhost.example") == 403
            assert await status(session, here, Origin="null") == 403
            for origin in ("http://example.org", f"http://127.0.0.1:{port + 1}", f"https://127.0.0.1:{port}", "null"):
                assert await socket_status(session, port, Origin=origin) == 403, origin
            assert await socket_status(session, port) == 403, "no Origin"
            assert await socket_status(session, port, Host="evil.example", Origin="http://evil.example") == 403
            assert await socket_status(session, port, Origin=here) == 101

    run(work)


def test_token_and_cookie_of_any_characters_are_refused() -> None:
    async def work() -> None:
        async with served() as (_, [address], port), a_browser() as session:
            here = f"http://127.0.0.1:{port}"
            assert await status(session, f"{here}/?token=%C3%A4%FF") == 403
            assert await status(session, here, Cookie=f"bot-console-{port}=ä") == 403
            await status(session, address)
            assert await status(session, here, Host='localhost:1"x') == 403

    run(work)


def test_malformed_request_prints_one_line_in_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    async def work() -> None:
        runner = web.AppRunner(Server(["true"], "127.0.0.1").application(), logger=one_line_log())
        await runner.setup()
        try:
            await web.TCPSite(runner, "127.0.0.1", 0).start()
            reader, writer = await asyncio.open_connection("127.0.0.1", runner.addresses[0][1])
            writer.write(b"GET / HTTP/1.1\r\nHost: \x1b]0;x\x07\r\n\r\n")
            assert (await reader.readline()).startswith(b"HTTP/1.0 400")
            writer.close()
        finally:
            await runner.cleanup()

    run(work)
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1 and lines[0].startswith("bot-console serve: ") and "\x1b" not in lines[0]


def test_page_that_closes_before_its_socket_opens_is_not_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    async def gone(*_: object) -> None:
        raise ConnectionResetError

    async def work() -> None:
        async with served() as (_, [address], port), a_browser() as session:
            await status(session, address)
            here = f"http://127.0.0.1:{port}"
            with monkeypatch.context() as patched:
                patched.setattr(web.WebSocketResponse, "prepare", gone)
                assert await status(session, f"{here}/ws", Origin=here) == 200
            assert await socket_status(session, port, Origin=here) == 101, "the session is free again"

    run(work)


def test_page_loads_nothing_from_elsewhere() -> None:
    async def work() -> None:
        async with served() as (_, [address], port), a_browser() as session:
            here = f"http://127.0.0.1:{port}"
            async with session.get(address) as answer:
                page = await answer.text()
                policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy and f"ws://127.0.0.1:{port}" in policy
            assert not re.findall(r"https?://", page)
            names = re.findall(r'(?:src|href)="(/static/[\w.-]+)"', page)
            assert len(names) == 4
            for each in names:
                async with session.get(here + each) as answer:
                    text = await answer.text()
                loaded = r"url\(\s*['\"]?(?:https?:)?//|@import|(?:src|href)\s*=\s*['\"]https?:|fetch\(['\"]https?:"
                assert not re.findall(loaded, text), each

    run(work)


def test_console_has_a_terminal_and_ends_with_its_tab(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "33")

    async def work() -> None:
        async with served() as (server, [address], port), a_browser() as session:
            here = f"http://127.0.0.1:{port}"
            await status(session, address)
            async with session.ws_connect(f"{here}/ws?width=90&height=30", origin=here) as socket:
                assert b"size 90 30 controls True." in await until(socket, b"True.")
                await socket.send_str(json.dumps(["resize", {"width": 100, "height": 20}]))
                for nonsense in ("{", "[]", '["resize", 3]', '["resize", {"width": -1, "height": "x"}]', '["stdin"]'):
                    await socket.send_str(nonsense)
                await socket.send_str(json.dumps(["stdin", "!"]))
                assert b"read b'!'.size 100 20" in await until(socket, b"True.")
                assert await socket_status(session, port, Origin=here) == 409, "one session"
                [admission] = server._admissions
                assert admission.terminal is not None
                process = admission.terminal._process
            await asyncio.to_thread(process.wait, 60)
            assert process.returncode == 0, "it got SIGHUP, and ended by itself"
            while await socket_status(session, port, Origin=here) != 101:
                await asyncio.sleep(0)

    run(work)


def test_signs_of_life_of_a_page_reach_its_console() -> None:
    async def work() -> None:
        async with served(console=WATCHING) as (_, [address], port), a_browser() as session:
            here = f"http://127.0.0.1:{port}"
            await status(session, address)
            async with session.ws_connect(f"{here}/ws", origin=here) as socket:
                await socket.send_str(json.dumps(["alive"]))
                await until(socket, b"alive b'.'.")

    run(work)


def test_each_address_has_its_own_session() -> None:
    async def work() -> None:
        async with served(2) as (_, addresses, port), a_browser() as first, a_browser() as second:
            here = f"http://127.0.0.1:{port}"
            for session, address in zip((first, second), addresses, strict=True):
                await status(session, address)
            async with first.ws_connect(f"{here}/ws", origin=here), second.ws_connect(f"{here}/ws", origin=here):
                pass

    run(work)


async def until(socket: Any, wanted: bytes) -> bytes:
    found = b""
    while wanted not in found:
        found += (await socket.receive()).data
    return found


@pytest.mark.parametrize(
    ("words", "code", "reported"),
    [
        (["run", "x.py"], 2, "'run' does not open a console"),
        (["--headless"], 2, "--headless has no screen"),
        (["nowhere"], 2, "there is no profile and no command 'nowhere'"),
        (["--host", "0.0.0.0"], 2, "means every network"),
        (["--host", "robot"], 2, "'robot' is not an address"),
        (["--sessions", "0"], 2, "--sessions: must be from 1 to 100"),
    ],
)
def test_wrong_usage_is_reported(
    words: list[str], code: int, reported: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        sys.exit(main(["serve", *words]))
    assert ended.value.code == code and reported in capsys.readouterr().err


def test_missing_extra_is_named(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    for name in [each for each in sys.modules if each.startswith("bot_console.tui.cli.serve.")]:
        if name.endswith((".server", ".terminal")):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "aiohttp", None)
    assert main(["serve"]) == 1
    assert "pip install 'bot-console[serve]'" in capsys.readouterr().err
