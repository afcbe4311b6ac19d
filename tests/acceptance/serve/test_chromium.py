"""The console in headless Chromium: by keyboard, by mouse and by touch, and after the browser has gone."""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from browser import CHROMIUM, Page, browser, new_page
from emulator import Emulator

pytestmark = pytest.mark.skipif(not CHROMIUM, reason="Chromium is not installed")
TIMEOUT_S = 280.0
SHOWN = "document.body?.classList.contains('-first-byte')"
ABOVE_STOP = (
    "document.querySelector('.xterm-screen').getBoundingClientRect().bottom"
    " <= document.getElementById('stop').getBoundingClientRect().top"
)
PICTURES = os.environ.get("BOT_CONSOLE_TESTS_PICTURES", "")
"""A folder in which pictures of the screen are kept for a person to look at."""


class Tab:
    """A page with the console, and the text of its terminal."""

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
        """The position in the window of the middle of a text."""
        y, line = next((y, line) for y, line in enumerate(self.lines()) if text in line)
        cell = await self.page.value(
            "(({width, height}) => [width, height])(document.querySelector('.xterm-screen').getBoundingClientRect())"
        )
        columns, rows = len(line), len(self.lines())
        return (line.index(text) + len(text) / 2) * cell[0] / columns, (y + 0.5) * cell[1] / rows

    async def keep(self, name: str) -> None:
        if PICTURES:
            await self.page.picture(Path(PICTURES, f"{name}.png"))


@contextmanager
def serving(*words: str) -> Iterator[tuple[str, int]]:
    """`bot-console serve` on a free port; yields its address and its process id."""
    line = [sys.executable, "-m", "bot_console.tui", "serve", "--port", "0", *words]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip(), process.pid
        finally:
            process.kill()


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """One browser for all tests of this file."""
    with browser(tmp_path_factory.mktemp("profile")) as address:
        yield address


@pytest.fixture
def watching_server() -> Iterator[tuple[str, int]]:
    """A server of read-only consoles."""
    with serving() as place:
        yield place


def consoles_of(process: int) -> list[int]:
    """The process ids of a server's consoles; a Linux kernel lists the children of a thread."""
    return [int(each) for each in Path(f"/proc/{process}/task/{process}/children").read_text().split()]


def run(work: Callable[[], Awaitable[Any]]) -> None:
    asyncio.run(asyncio.wait_for(work(), TIMEOUT_S))  # type: ignore[arg-type]


@pytest.mark.slow
def test_watching_console_takes_keys_mouse_and_touch_and_its_stop_works(
    chromium: str, watching_server: tuple[str, int]
) -> None:
    address, server = watching_server

    async def work() -> None:
        async with new_page(chromium) as page:
            tab = Tab(page)
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


def test_tablet_has_a_stop_button(chromium: str, watching_server: tuple[str, int]) -> None:
    address, _ = watching_server

    async def work() -> None:
        async with new_page(chromium) as page:
            tab = Tab(page)
            await tab.open(address, 768, 1024, touch=True)
            await tab.shows("DRIVING")
            await tab.page.until(bool, ABOVE_STOP)
            await tab.keep("768x1024")
            await tab.page.tap(384, 1000)
            await tab.shows("ALL STOP")
            await tab.keep("768x1024-stopped")

    run(work)


@pytest.mark.slow
def test_silent_browser_ends_a_console_that_steers(chromium: str) -> None:
    async def work(address: str, server: int) -> None:
        async with new_page(chromium) as page:
            tab = Tab(page)
            await tab.open(address, 1280, 800)
            await tab.shows("DRIVING")
            await tab.page.press("Enter")
            await tab.shows("ARMED")
            assert consoles_of(server)
            await tab.page.freeze()
            while consoles_of(server):  # The page's sockets are still open, as behind a tunnel.
                await asyncio.sleep(0.05)

    with serving("--control", "--pane", "steering") as place:
        run(lambda: work(*place))
