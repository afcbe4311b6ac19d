"""A headless Chromium, driven over its DevTools protocol: pages, keys, the mouse, touch sizes, pictures."""

from __future__ import annotations

import asyncio
import base64
import shutil
import subprocess
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any

from aiohttp import ClientSession, ClientWebSocketResponse

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
CHROMIUM = next((place for name in NAMES if (place := shutil.which(name))), "")
OPTIONS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
           "--no-first-run", "--disable-background-networking", "--disable-component-update", "--no-proxy-server",
           "--remote-debugging-port=0")  # fmt: skip


class Page:
    """A tab."""

    def __init__(self, socket: ClientWebSocketResponse) -> None:
        self._socket = socket
        self._last = 0
        self._answers: dict[int, asyncio.Future[Any]] = {}
        self.received: list[bytes] = []
        """What came in over the page's socket."""
        self.socket_address = ""
        self.requests: list[str] = []
        """The addresses of everything that the page has asked for."""
        self._reading = asyncio.ensure_future(self._read())

    async def _read(self) -> None:
        async for message in self._socket:
            found = message.json()
            if (waiting := self._answers.pop(found.get("id", 0), None)) is not None and not waiting.done():
                waiting.set_result(found)
            if found.get("method") == "Network.requestWillBeSent":
                self.requests.append(found["params"]["request"]["url"])
            if found.get("method") == "Network.webSocketCreated":
                self.socket_address = found["params"]["url"]
                self.requests.append(self.socket_address)
            if found.get("method") == "Network.webSocketFrameReceived":
                frame = found["params"]["response"]
                self.received.append(base64.b64decode(frame["payloadData"]) if frame["opcode"] == 2 else b"")

    async def ask(self, method: str, **params: Any) -> Any:
        """Send a command of the protocol and return its result."""
        self._last += 1
        answer = self._answers[self._last] = asyncio.get_running_loop().create_future()
        await self._socket.send_json({"id": self._last, "method": method, "params": params})
        found = await answer
        assert "error" not in found, found
        return found["result"]

    async def open(self, address: str, width: int, height: int, *, touch: bool = False) -> None:
        """Open an address in a window of that size (CSS pixels)."""
        for domain in ("Page", "Network", "Runtime"):
            await self.ask(f"{domain}.enable")
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}
        await self.ask("Emulation.setDeviceMetricsOverride", **size)
        await self.ask("Emulation.setTouchEmulationEnabled", enabled=touch)
        await self.ask("Page.navigate", url=address)

    async def value(self, expression: str) -> Any:
        """Evaluate an expression in the page."""
        answer = await self.ask("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    async def until(self, holds: Callable[[Any], bool], expression: str) -> Any:
        """Evaluate an expression until its value satisfies `holds`; return the value."""
        while True:
            found = await self.value(expression)
            if holds(found):
                return found
            await asyncio.sleep(0.05)

    async def press(self, key: str, code: str = "") -> None:
        """Press and release a key: a character, or the name of a key with its code."""
        text = {"text": key} if len(key) == 1 else {"text": "\r"} if key == "Enter" else {}
        await self.ask("Input.dispatchKeyEvent", type="keyDown", key=key, code=code or key, **text)
        await self.ask("Input.dispatchKeyEvent", type="keyUp", key=key, code=code or key)

    async def click(self, x: float, y: float) -> None:
        """Click with the mouse."""
        for kind in ("mousePressed", "mouseReleased"):
            await self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    async def tap(self, x: float, y: float) -> None:
        """Touch the screen."""
        await self.ask("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        await self.ask("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    async def picture(self, file: Path) -> None:
        """Save a picture of the window."""
        answer = await self.ask("Page.captureScreenshot", format="png")
        file.write_bytes(base64.b64decode(answer["data"]))

    async def close(self) -> None:
        """Close the tab."""
        await self.ask("Page.close")

    async def freeze(self) -> None:
        """Freeze the page: its scripts stop, while its connections stay open."""
        await self.ask("Debugger.enable")
        await self.ask("Debugger.pause")


@contextmanager
def browser(folder: Path) -> Iterator[str]:
    """Start a browser with a separate profile; yield the address at which it accepts commands."""
    line = [CHROMIUM, *OPTIONS, f"--user-data-dir={folder}", "about:blank"]
    with subprocess.Popen(line, stderr=subprocess.PIPE) as process:
        assert process.stderr is not None
        try:
            while b"DevTools listening on" not in (row := process.stderr.readline()):
                assert row, "the browser has ended"
            yield row.decode().split()[-1].replace("ws://", "http://").partition("/devtools")[0]
        finally:
            process.kill()


@asynccontextmanager
async def new_page(address: str) -> AsyncIterator[Page]:
    """A new tab of the browser at an address; it is closed at the end of the block."""
    async with ClientSession() as session:
        async with session.put(f"{address}/json/new?about:blank") as answer:
            found = await answer.json()
        try:
            yield Page(await session.ws_connect(found["webSocketDebuggerUrl"], max_msg_size=0))
        finally:
            await session.get(f"{address}/json/close/{found['id']}")
