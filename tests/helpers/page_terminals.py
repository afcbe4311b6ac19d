"""The terminals of the course page: its commands as node processes in real time, with the console's screen beside
them.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from bot_console.runtime.process import RealTime
from bot_console.runtime.process.virtual.install import reinstall_stdio, uninstall_virtual_process
from bot_console.runtime.workspace import discover
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.settings.appearance import Appearance
from course.page import make_workspace
from fakes.launcher import FakeLauncher
from piloting import Session
from rest import at_rest
from systems import Program, System
from textual.events import Paste

TIMEOUT_S = 60.0
"""Seconds after which a test gives up; the tests measure no time."""


class Screen(Session):
    """A session over a real console, which answers asynchronously."""

    async def until(self, true: Callable[[], object], what: str) -> None:
        """Let the app run until a condition holds."""
        deadline = time.monotonic() + TIMEOUT_S
        while not true():
            assert time.monotonic() < deadline, f"no {what} on\n{self.text()}"
            await self.pilot.pause(0.02)
            await self.settle()

    async def shows(self, *texts: str) -> None:
        """Wait until all texts are on the screen, in whatever spacing."""
        await self.until(lambda: all(each in " ".join(self.text().split()) for each in texts), f"{texts}")

    async def line(self, text: str) -> None:
        """Run a command copied from the page on the console's command line."""
        await self.press(":")
        await self.enter(text)

    async def enter(self, text: str) -> None:
        """Paste a text into the focused field, which is faster than typing it, and press Enter."""
        self.app.post_message(Paste(text))
        await self.settle()
        await self.press("enter")


class Terminals:
    """A workspace with the page's package, terminals in it, and one console for all of a module's tests."""

    def __init__(self, workspace: Path) -> None:
        self.workspace = workspace
        self.system: System = System(RealTime())  # type: ignore[arg-type] # it only starts and asks, nothing is stepped
        self.programs: list[Program] = []
        self.console = RosConsole()
        self.console.start()
        assert self.console.wait_ready(TIMEOUT_S)

    def start(self, command: str) -> Program:
        """Type a `ros2` line into a separate terminal, where it keeps running."""
        self.programs.append(self.system.ros2(*command.split()[1:]))
        return self.programs[-1]

    def ask(self, command: str) -> Program:
        """Type a `ros2` line into another terminal and run it to its end."""
        return self.system.finish(self.start(command))

    def node(self, text: str) -> Program:
        """Start a node that the page leaves to the reader."""
        self.programs.append(self.system.python("-c", text))
        return self.programs[-1]

    def show(
        self,
        play: Callable[[Screen], Awaitable[None]],
        size: tuple[int, int] = (120, 40),
        appearance: Appearance | None = None,
        plugins: Callable[[], Sequence[PaneEntry]] = tuple,
    ) -> None:
        """Open the console beside the terminals and play a scene in it."""

        async def main() -> None:
            launcher = FakeLauncher()
            self.console.launcher = launcher
            app = BotConsoleApp(self.console, refresh_hz=0, appearance=appearance, plugins=plugins)
            async with app.run_test(size=size, notifications=True) as pilot:
                reinstall_stdio()
                screen: Any = Screen(app, pilot, self.console, launcher)  # type: ignore[arg-type] # a real one
                await screen.settle()
                await play(screen)
                assert app.controls.faults.seen == [], "a pane has ended by a fault"

        with at_rest():
            asyncio.run(main())


@contextmanager
def terminals(folder: Path) -> Iterator[Terminals]:
    """The page's workspace and its terminals, all ended when the block is left."""
    before = discover.workspace()
    discover.use(discover.Workspace([make_workspace(folder) / "src"]))
    running = Terminals(folder)
    try:
        yield running
    finally:
        running.console.close()
        for each in running.programs:
            each.process.kill()
        discover.use(before)
        uninstall_virtual_process()
