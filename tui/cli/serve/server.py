"""The web server: authentication, and the files of the page. It reveals nothing to anybody without a cookie."""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import logging
import secrets
import signal
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

import textual_serve
from aiohttp import web
from bot_console.tui.cli.serve.terminal import Terminal
from bot_console.tui.text.sanitize import sanitize

PAGE = Path(__file__).resolve().parent / "page"
FONT_SIZE_PX = 14
LOOPBACK_NAMES = ("localhost", "127.0.0.1", "[::1]")
"""The names under which a browser may reach this machine through a tunnel, at any port."""
HEADERS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; font-src 'self'; img-src data:; "
        "connect-src 'self' {socket}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
}
TOKEN_USED = (
    "This address has been used in another browser. `bot-console serve` prints a new one when it is started again."
)
NOT_ADMITTED = "Open the address that `bot-console serve` printed."
OPEN_ELSEWHERE = "The console is open in another tab."
MAX_MESSAGE_BYTES = 1_000_000


@dataclass
class Admission:
    """The admission of one browser."""

    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    """The token in the printed address; empty once it was exchanged for the cookie."""
    cookie: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    terminal: Terminal | None = None
    """The console that is open; None if none is."""


class Server:
    """Serves one console at a time to each admitted browser."""

    def __init__(self, console: Sequence[str], host: str, *, sessions: int = 1) -> None:
        """`console` is the command that starts a console."""
        self.host = host
        self._console = console
        self._name = f"[{host}]" if ":" in host else host
        self._admissions = [Admission() for _ in range(sessions)]
        self._port = 0

    def addresses(self, port: int) -> list[str]:
        """The addresses to print, once the port is known."""
        self._port = port
        return [f"http://{self._name}:{port}/?token={each.token}" for each in self._admissions]

    def application(self) -> web.Application:
        """Create the application that answers requests."""
        app = web.Application(middlewares=[self._checked])
        app.router.add_get("/", self._page)
        app.router.add_get("/ws", self._socket)
        app.router.add_get("/static/{name}", self._file)
        app.on_shutdown.append(self._end)
        return app

    @web.middleware
    async def _checked(
        self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        """Refuse requests made by other pages, or for another host name (DNS rebinding)."""
        own = {self._name, *LOOPBACK_NAMES}
        host = request.headers.get("Host", "")
        origin = request.headers.get("Origin")
        try:
            name, _, port = host.rpartition(":")
            if host not in own and not (name in own and port.isdecimal()):
                raise web.HTTPForbidden(text="This is not the address of this server.")
            if origin is None and request.path == "/ws":
                raise web.HTTPForbidden(text="Only the page may open a socket.")
            if origin is not None and origin != f"http://{host}":
                raise web.HTTPForbidden(text="This request came from another page.")
            response = await handler(request)
        except web.HTTPException as error:
            error.headers.update(_headers(host))
            raise
        if not response.prepared:
            response.headers.update(_headers(host))
        return response

    def _admission(self, request: web.Request) -> Admission | None:
        given = request.cookies.get(self._cookie_name, "")
        return next((each for each in self._admissions if _is_same(each.cookie, given)), None)

    @property
    def _cookie_name(self) -> str:
        return f"bot-console-{self._port}"  # Cookies of a host are shared by its ports.

    async def _page(self, request: web.Request) -> web.StreamResponse:
        admission = self._admission(request)
        if "token" in request.query:
            return self._admit(request.query["token"], admission)
        if admission is None:
            raise web.HTTPForbidden(text=NOT_ADMITTED)
        text = (PAGE / "page.html").read_text("utf-8")
        socket = f"ws://{request.headers['Host']}/ws"
        return web.Response(text=text.format(socket=socket, font_size=FONT_SIZE_PX), content_type="text/html")

    def _admit(self, token: str, admission: Admission | None) -> web.StreamResponse:
        """Exchange a token for a cookie, once, and redirect to the address without the token."""
        meant = next((each for each in self._admissions if each.token and _is_same(each.token, token)), None)
        if meant is None and admission is None:
            raise web.HTTPForbidden(text=TOKEN_USED)
        response = web.Response(status=303, headers={"Location": "/"})
        if meant is not None:
            meant.token = ""
            response.set_cookie(self._cookie_name, meant.cookie, httponly=True, samesite="Strict", path="/")
        return response

    async def _file(self, request: web.Request) -> web.StreamResponse:
        if self._admission(request) is None:
            raise web.HTTPForbidden(text=NOT_ADMITTED)
        path = _static_files().get(request.match_info["name"])
        if path is None:
            raise web.HTTPNotFound
        return web.FileResponse(path)

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        admission = self._admission(request)
        if admission is None:
            raise web.HTTPForbidden(text=NOT_ADMITTED)
        if admission.terminal is not None:
            raise web.HTTPConflict(text=OPEN_ELSEWHERE)
        size = _number(request, "width", 80), _number(request, "height", 24)
        admission.terminal = Terminal(self._console, size)
        try:
            socket = web.WebSocketResponse(max_msg_size=MAX_MESSAGE_BYTES)
            try:
                await socket.prepare(request)
            except ConnectionError:  # the browser has gone already
                return web.Response()
            await admission.terminal.show(socket)
            return socket
        finally:
            await admission.terminal.close()
            admission.terminal = None

    async def _end(self, _app: web.Application) -> None:
        await asyncio.gather(*(each.terminal.close() for each in self._admissions if each.terminal is not None))


def serve(server: Server, port: int) -> int:
    """Print the addresses and serve until SIGINT, SIGTERM or SIGHUP; then end every console and return."""
    return asyncio.run(_serve(server, port))


async def _serve(server: Server, port: int) -> int:
    runner = web.AppRunner(server.application(), access_log=None, logger=one_line_log(), shutdown_timeout=0.5)
    await runner.setup()
    try:
        site = web.TCPSite(runner, server.host, port)
        await site.start()
        over = asyncio.Event()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            asyncio.get_running_loop().add_signal_handler(number, over.set)
        bound = runner.addresses[0][1]
        for address in server.addresses(bound):
            print(address, flush=True)
        with contextlib.suppress(asyncio.CancelledError):
            await over.wait()
    finally:
        await runner.cleanup()
    return 0


class _OneLine(logging.Formatter):
    """Formats an error on one line, without a traceback, since anybody on this machine may send invalid requests."""

    def format(self, record: logging.LogRecord) -> str:
        fault = record.exc_info[1] if record.exc_info else ""
        return sanitize(" ".join(f"bot-console serve: {record.getMessage()}: {fault}".split()))


def one_line_log() -> logging.Logger:
    """The log of the web server, on stderr."""
    log = logging.Logger("bot-console serve", logging.WARNING)
    handler = logging.StreamHandler()
    handler.setFormatter(_OneLine())
    log.addHandler(handler)
    return log


def _is_same(secret: str, given: str) -> bool:
    """Compare with a secret in a time that does not depend on the secret."""
    return hmac.compare_digest(secret.encode(), given.encode("utf-8", "surrogatepass"))


def _headers(host: str) -> dict[str, str]:
    safe = host if all(each.isalnum() or each in ".:[]-" for each in host) else ""
    return {name: text.replace("{socket}", f"ws://{safe}") for name, text in HEADERS.items()}


def _static_files() -> dict[str, Path]:
    theirs = Path(str(files(textual_serve))) / "static"
    return {
        "page.css": PAGE / "page.css",
        "page.js": PAGE / "page.js",
        "textual.js": theirs / "js" / "textual.js",
        "xterm.css": theirs / "css" / "xterm.css",
        "RobotoMono.ttf": theirs / "fonts" / "RobotoMono-VariableFont_wght.ttf",
        "RobotoMono-Italic.ttf": theirs / "fonts" / "RobotoMono-Italic-VariableFont_wght.ttf",
    }


def _number(request: web.Request, name: str, default: int) -> int:
    text = request.query.get(name, "")
    return min(int(text), 1000) if text.isdecimal() and len(text) < 6 and int(text) else default
