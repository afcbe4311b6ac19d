"""The console in headless Chromium: by keyboard, by mouse and by touch, and what happens when the browser is gone."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from browser import CHROMIUM, Page, browser
from emulator import Emulator

pytestmark = pytest.mark.skipif(not CHROMIUM, reason="there is no Chromium")
TIMEOUT_S = 280.0
SHOWN = "document.body?.classList.contains('-first-byte')"
ABOVE_STOP = (
    "document.querySelector('.xterm-screen').getBoundingClientRect().bottom"
    " <= document.getElementById('stop').getBoundingClientRect().top"
)
PICTURES = os.environ.get("BOT_CONSOLE_TESTS_PICTURES", "")
"""A folder in which to keep pictures of the screen, to be looked at."""


class Tab:
    """A page with the console, and what its terminal shows."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self._fed = 0
        self._screen: Emulator | None = None

    async def open(self, address: str, width: int, height: int, *, touch: bool = False) -> None:
        await self.page.open(address, width, height, touch=touch)
        await self.page.until(bool, SHOWN)
        size = parse_qs(urlsplit(self.page.socket_address).query)
        self._screen = Emulator(int(size["width"][0]), int(size["height"][0]))

    async def shows(self, text: str) -> None:
        try:
            while not any(text in line for line in self.lines()):
                await asyncio.sleep(0.05)
        except asyncio.CancelledError:
            print("\n".join(self.lines()))
            raise

    def lines(self) -> list[str]:
        assert self._screen is not None
        new = self.page.received[self._fed :]
        self._fed += len(new)
        self._screen.feed(b"".join(new).decode("utf-8", "replace"))
        return self._screen.lines()

    async def place_of(self, text: str) -> tuple[float, float]:
        """Where in the window the middle of a text is."""
        y, line = next((y, line) for y, line in enumerate(self.lines()) if text in line)
        cell = await self.page.value(
            "(({width, height}) => [width, height])(document.querySelector('.xterm-screen').getBoundingClientRect())"
        )
        columns, rows = len(line), len(self.lines())
        return (line.index(text) + len(text) / 2) * cell[0] / columns, (y + 0.5) * cell[1] / rows

    async def keep(self, name: str) -> None:
        if PICTURES:
            await self.page.picture(Path(PICTURES, f"{name}.png"))


@asynccontextmanager
async def serving(*words: str) -> AsyncIterator[tuple[str, asyncio.subprocess.Process]]:
    """`bot-console serve` on a free port: its address, and its process."""
    line = [sys.executable, "-m", "bot_console.tui", "serve", "--port", "0", *words]
    process = await asyncio.create_subprocess_exec(*line, stdout=asyncio.subprocess.PIPE)
    assert process.stdout is not None
    try:
        yield (await process.stdout.readline()).decode().strip(), process
    finally:
        process.kill()
        await process.wait()


def consoles_of(process: asyncio.subprocess.Process) -> list[int]:
    """The consoles that a server runs; a Linux kernel lists the children of a thread."""
    return [int(each) for each in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]


def run(work: Callable[[], Awaitable[Any]]) -> None:
    asyncio.run(asyncio.wait_for(work(), TIMEOUT_S))  # type: ignore[arg-type]


def test_watching_console_takes_keys_mouse_and_touch_and_its_stop_works(tmp_path: Path) -> None:
    async def work() -> None:
        async with serving() as (address, server), browser(tmp_path) as new:
            tab = Tab(await new())
            await tab.open(address, 1280, 800)
            assert await tab.page.value("location.search + document.cookie") == ""
            await tab.shows("DRIVING")
            await tab.keep("1280x800")
            await tab.page.press("?", "Slash")
            await tab.shows("Help for this pane")
            await tab.page.press("Escape")
            await tab.page.click(*await tab.place_of("2 Logs"))
            await tab.shows("Filter")
            await tab.page.press("!", "Digit1")
            await tab.shows("ALL STOP")
            await tab.page.press("6", "Digit6")
            await tab.page.press("Enter")
            await tab.shows("read-only")
            hosts = {each.split("/")[2] for each in tab.page.requests if not each.startswith("data:")}
            assert hosts == {address.split("/")[2]}
            await tab.page.close()
            while consoles_of(server):
                await asyncio.sleep(0.05)

    run(work)


def test_tablet_has_a_stop_button(tmp_path: Path) -> None:
    async def work() -> None:
        async with serving() as (address, _), browser(tmp_path) as new:
            tab = Tab(await new())
            await tab.open(address, 768, 1024, touch=True)
            await tab.shows("DRIVING")
            await tab.page.until(bool, ABOVE_STOP)
            await tab.keep("768x1024")
            await tab.page.tap(384, 1000)
            await tab.shows("ALL STOP")
            await tab.keep("768x1024-stopped")

    run(work)


def test_silent_browser_ends_a_console_that_steers(tmp_path: Path) -> None:
    async def work() -> None:
        async with serving("--control", "--pane", "steering") as (address, server), browser(tmp_path) as new:
            tab = Tab(await new())
            await tab.open(address, 1280, 800)
            await tab.shows("DRIVING")
            await tab.page.press("Enter")
            await tab.shows("ARMED")
            assert consoles_of(server)
            await tab.page.freeze()
            while consoles_of(server):  # The page's sockets are still open, as behind a tunnel.
                await asyncio.sleep(0.05)

    run(work)
