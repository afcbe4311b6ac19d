"""Takes the pictures of the README and of the documentation from a real run of the console, in about two minutes.

python tools/screenshots.py [docs/images]
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path

from bot_console.runtime.importer import install

install()

from bot_console.tui.cli.arguments import Options
from bot_console.tui.files.folders import config_folder
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.session.embedded.workspaces import choose
from bot_console.tui.session.live import Session
from textual.pilot import Pilot

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "images"
LARGE, SMALL = (120, 40), (80, 24)
DRIVE_S = 25.0
"""Seconds of driving before the first change, and again before the first picture."""
BEGINNER = Path(tempfile.gettempdir()) / "beginner"
"""The home folder of a user without settings or history; its name is visible in the pictures."""
GENTLE = """# Gentle: near people
/robot_navigator:
  ros__parameters: {max_speed: 0.6, safety_distance: 0.8}
/safety_monitor:
  ros__parameters: {warning_distance: 0.25}
/sensor_handler:
  ros__parameters: {update_rate: 20.0}
/motion_controller:
  ros__parameters: {kp_angular: 50.0}
"""
MEASURE_S = 8.0
"""Seconds to wait until the graph shows rates."""
RESPONSE_S = 3.0
"""Seconds of driving with each of two sets of values."""
TIMEOUT_S = 30.0
FONTS = "'DejaVu Sans Mono', 'Fira Code', Menlo, Consolas, monospace"
FONT_FACE = re.compile(r"@font-face \{.*?\}", re.DOTALL)
CLASS_PREFIX = re.compile(r"terminal-\d+-")
"""The prefix that Rich puts before each class name, for pages that contain several pictures inline."""


class Photographer:
    """A running console, its keys, and the folder for its pictures."""

    def __init__(self, session: Session, pilot: Pilot[None], folder: Path) -> None:
        self._session, self._pilot, self._folder = session, pilot, folder

    async def drive(self, seconds: float) -> None:
        """Let the robot drive for `seconds`."""
        await self._pilot.pause(seconds)

    async def until(self, condition: Callable[[], object]) -> None:
        """Wait until a condition holds."""
        for _ in range(int(TIMEOUT_S / 0.05)):
            if condition():
                return
            await self._pilot.pause(0.05)
        raise TimeoutError("the system does not reach the state that the picture is to show")

    async def press(self, *keys: str) -> None:
        """Press keys one after the other."""
        for key in keys:
            await self._pilot.press(key)
            await self._pilot.pause(0.05)

    async def select(self, name: str) -> None:
        """Move the cursor down to a parameter."""
        await self.until(lambda: self._session.app.query(ParameterRows))  # The panes appear after the first frame.
        rows = self._session.app.query_one(ParameterRows)
        await self.until(lambda: any(each.name == name for each in rows.rows))
        for _ in rows.rows:
            if rows.current and rows.current.name == name:
                return
            await self.press("down")

    async def enter(self, text: str) -> None:
        """Edit the selected parameter."""
        await self.press("enter", *["backspace"] * 12, *_keys(text), "enter")
        await self._pilot.pause(0.5)

    async def find(self, name: str) -> None:
        """Filter for a parameter, which also moves the cursor to it."""
        await self.press("1", "slash", *["backspace"] * 20, *_keys(name), "enter")

    async def steer_until_limited(self) -> None:
        """Drive forward, pressing a key often enough for the dead-man switch, until an obstacle is ahead."""
        for _ in range(int(TIMEOUT_S)):
            if self._session.console.snapshot().drive.limited_by == "warning_distance":
                return
            await self.press("w", "s")
            await self._pilot.pause(0.9)

    async def resize(self, size: tuple[int, int]) -> None:
        """Change the size of the terminal (columns, lines)."""
        await self._pilot.resize_terminal(*size)
        await self._pilot.pause(0.5)

    def keep_profile(self, name: str, text: str) -> None:
        """Write a profile to the user's folder, where the console finds it."""
        folder = config_folder() / "profiles"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")

    def picture(self, prefix: str = "") -> str:
        """The screen as an SVG that uses the reader's fonts and loads none; its class names begin with `prefix`."""
        svg = self._session.app.export_screenshot(title="bot-console")
        svg = FONT_FACE.sub("", svg).replace("font-family: Fira Code, monospace", f"font-family: {FONTS}")
        svg = CLASS_PREFIX.sub(prefix, svg)
        return "\n".join(line.strip() for line in svg.splitlines() if line.strip()) + "\n"

    def take(self, name: str) -> None:
        """Save the screen as an SVG."""
        self.save(name, self.picture())

    def save(self, name: str, svg: str) -> None:
        """Save a picture."""
        (self._folder / f"{name}.svg").write_text(svg, encoding="utf-8")
        print(f"{name}.svg  {len(svg) // 1024} KiB")


def _keys(text: str) -> list[str]:
    """The keys that type a text."""
    return [{".": "full_stop", "_": "underscore"}.get(character, character) for character in text]


async def tune(at: Photographer) -> None:
    """Mark two values, send them as set B and swap; then the history, and a profile before it is applied."""
    await at.find("max_speed")
    await at.press("m")
    await at.enter("1.2")
    await at.find("max_acceleration")
    await at.enter("3.0")
    await at.find("max_")
    await at.drive(0.5)
    at.take("tuning-marked")
    for _ in range(2):
        await at.press("A", "y")
        await at.drive(RESPONSE_S)
    await at.press("H", *["down"] * 2, "u")
    await at.drive(0.5)
    at.take("tuning-history")
    at.keep_profile("gentle", GENTLE)
    await at.press("n", "7", "slash", *"gentle", "enter")
    await at.drive(2.0)
    at.take("tuning-profile")


async def take_all(at: Photographer) -> None:
    """Play the scenes."""
    await at.select("max_speed")
    await at.drive(DRIVE_S)
    await at.enter("1.6")
    await at.drive(DRIVE_S)
    await at.enter("10.0")
    at.take("overview")
    await at.press("3")
    await at.drive(MEASURE_S)
    at.take("graph")
    await at.resize(SMALL)
    await at.press("1")
    at.take("parameters")
    await at.press("5")
    await at.drive(0.5)
    at.take("world")
    await tune(at)
    await at.press("6", "enter", "W")
    await at.steer_until_limited()
    at.take("steering")


async def main(folder: Path, play: Callable[[Photographer], Awaitable[None]], size: tuple[int, int]) -> None:
    """Start the robot's system, take the pictures as a new user sees it, and end it."""
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["BOT_CONSOLE_USER_DIR"] = str(BEGINNER)
    shutil.rmtree(BEGINNER, ignore_errors=True)  # left by an interrupted run
    BEGINNER.mkdir()
    choose([BEGINNER])  # otherwise the packages below the current directory would add their panes
    session = Session(Options(seed=1, workspace=[BEGINNER]))
    try:
        async with session.app.run_test(size=size) as pilot:
            await play(Photographer(session, pilot, folder))
            session.console.drive.stop(True)
    finally:
        await asyncio.to_thread(session.close)
        shutil.rmtree(BEGINNER, ignore_errors=True)


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER, take_all, LARGE))
