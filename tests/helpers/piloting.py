"""Runs the app over a sample system and presses keys, without timers and without a real clock."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import TypeVar

from bot_console.tui.app import BotConsoleApp
from bot_console.tui.panes.alarms.pane import AlarmsPane
from bot_console.tui.panes.diagnostics.pane import DiagnosticsPane
from bot_console.tui.panes.images.pane import ImagesPane
from bot_console.tui.panes.launch.pane import LaunchPane
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.steering.pane import SteeringPane
from bot_console.tui.settings.appearance import Appearance
from fakes.command_line import FakeCommandLine
from fakes.console import FakeConsole
from fakes.launcher import FakeLauncher
from rest import at_rest, rest_undrawn
from textual import events
from textual.keys import _character_to_key
from textual.pilot import Pilot
from textual.widget import Widget

P = TypeVar("P", bound=Widget)


@dataclass
class Session:
    """A running app, with the console and the launcher that it uses."""

    app: BotConsoleApp
    pilot: Pilot[None]
    console: FakeConsole
    launcher: FakeLauncher

    async def press(self, *keys: str) -> None:
        """Press keys, each after the effects of the previous one are complete; then let the app draw."""
        for key in keys:
            await self.pilot.press(key)
            self._pull()
            await rest_undrawn()
        await self.pilot.pause()

    async def type(self, text: str) -> None:
        """Type a text into the focused field, without drawing in between."""
        for character in text:
            self.app.post_message(events.Key(_character_to_key(character), character))
        await self.settle()

    async def paste(self, text: str) -> None:
        """Paste a text into the focused field, in tests that are not about typing."""
        self.app.post_message(events.Paste(text))
        await self.settle()

    async def click(self, text: str, *, times: int = 1, last: bool = False) -> None:
        """Click on the beginning of a text on the screen, at its first or last occurrence."""
        lines = self.lines()
        found = [(line.rindex(text) if last else line.index(text), y) for y, line in enumerate(lines) if text in line]
        assert found, f"{text!r} is not on the screen:\n{self.text()}"
        await self.pilot.click(offset=found[-1 if last else 0], times=times)
        await self.settle()

    async def click_tab(self, digit: str) -> None:
        """Click on the tab of a pane."""
        found = re.search(rf"(?<=[\[\] ]){digit} \w+", self.lines()[0])
        assert found, self.lines()[0]
        await self.click(found.group())

    async def settle(self) -> None:
        """Let everything that is pending happen."""
        self._pull()
        await self.pilot.pause()

    def _pull(self) -> None:
        if len(self.app.screen_stack) == 1:
            self.app.pull()

    def pane(self, kind: type[P]) -> P:
        """The pane or widget of a class."""
        return self.app.screen_stack[0].query_one(kind)

    def lines(self) -> list[str]:
        """The lines on the screen."""
        return [strip.text for strip in self.app.screen._compositor.render_strips()]

    def text(self) -> str:
        """The screen as one text."""
        return "\n".join(self.lines())


class Clock:
    """A monotonic clock advanced by the test."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def run(
    system: tuple[FakeConsole, FakeLauncher],
    play: Callable[[Session], Awaitable[None]],
    size: tuple[int, int] = (80, 24),
    *,
    faults_wanted: bool = False,
    appearance: Appearance | None = None,
) -> None:
    """Run the app at a size and play a scene in it; an exception in a pane fails the test unless it is expected."""

    async def main() -> None:
        console, launcher = system
        console.launcher = launcher
        app = BotConsoleApp(console, FakeCommandLine(console.asked), refresh_hz=0, appearance=appearance)
        with at_rest(is_scripted=True):
            async with app.run_test(size=size, notifications=True) as pilot:
                session = Session(app, pilot, console, launcher)
                for kind in (SteeringPane, DiagnosticsPane, AlarmsPane, ImagesPane, LaunchPane, LogsPane):
                    session.pane(kind).clock = Clock()
                await session.settle()
                await play(session)
                if not faults_wanted:
                    assert app.controls.faults.seen == [], "a pane has failed"

    asyncio.run(main())
