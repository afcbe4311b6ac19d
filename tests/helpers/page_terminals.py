"""The terminals of the course page: its commands and programs run in real time beside the console's screen."""

from __future__ import annotations

import asyncio
import os
import signal
import threading
import time
from collections.abc import Awaitable, Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any

from bot_console.runtime.children.child_discovery import let_children_meet
from bot_console.runtime.children.own_fork_server import begun
from bot_console.runtime.process import RealTime
from bot_console.runtime.process.fork_server import Job, Report
from bot_console.runtime.process.virtual.install import reinstall_stdio, uninstall_virtual_process
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses
from bot_console.runtime.workspace import discover
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.session.embedded.domain import join_domain
from bot_console.tui.settings.appearance import Appearance
from course.page import make_workspace
from fakes.launcher import FakeLauncher
from piloting import Session
from rest import at_rest
from systems import Program, System, environment_of_programs
from textual.events import Paste

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; the tests measure no time."""


class Screen(Session):
    """A session over a real console, whose answers arrive asynchronously."""

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


class Live:
    """A program in a separate process that has joined the domain."""

    def __init__(self, name: str, program: str, arguments: Sequence[Any]) -> None:
        """`program` names the function that returns the program to run, called with `arguments`."""
        self._job = partial(Job, name, f"{begun.__module__}:{begun.__name__}", (True, program, arguments))
        self._report = Report()
        self._ended = threading.Event()

    def start(self, argv: Sequence[str], env: dict[str, str], output: Callable[[str, str], None]) -> None:
        """Start the process with an empty standard input; `output` is called with each stream's name and text."""
        from launch.child.forked_child import start_job

        own = start_job(self._job(list(argv), env, os.getcwd()), emulate_tty=False)
        os.close(own.stdin)
        os.close(own.data)
        for stream, descriptor in (("stdout", own.stdout), ("stderr", own.stderr)):
            threading.Thread(target=_read, args=(descriptor, partial(output, stream)), daemon=True).start()
        threading.Thread(target=self._follow, args=(own.report,), daemon=True).start()

    def _follow(self, descriptor: int) -> None:
        _read(descriptor, lambda text: self._report.feed(text.encode()))
        self._ended.set()

    @property
    def exit_code(self) -> int | None:
        """Its exit code; None while it runs."""
        return self._report.exit_code

    def interrupt(self) -> None:
        """Send it SIGINT."""
        self._send(signal.SIGINT)

    def kill(self) -> None:
        """Send it SIGKILL."""
        self._send(signal.SIGKILL)

    def _send(self, number: int) -> None:
        while self._report.pid is None and not self._ended.wait(0.01):
            pass
        if self._report.pid is not None and not self._ended.is_set():
            with suppress(ProcessLookupError):  # it has just ended
                os.kill(self._report.pid, number)

    def wait(self, timeout_s: float) -> int | None:
        """Wait for its end, at most `timeout_s` seconds; returns its exit code."""
        self._ended.wait(timeout_s)
        return self.exit_code

    def line(self) -> str:
        """The line at which it is, for the message of a failed test."""
        return f"process {self._report.pid}"


def _read(descriptor: int, take: Callable[[str], None]) -> None:
    with open(descriptor, encoding="utf-8", errors="replace") as stream:
        for line in stream:
            take(line)


class LiveSystem(System):
    """Programs in real time, in the domain that this process has joined."""

    def __init__(self) -> None:
        super().__init__(RealTime())  # type: ignore[arg-type] # it only starts and asks, nothing is stepped
        self._folder = os.environ["BOT_CONSOLE_SOCKET_DIR"]

    def start(self, name: str, program: str, arguments: Sequence[Any], argv: Sequence[str]) -> Program:
        """Start a program in a process of its own."""
        process = Live(name, program, arguments)
        started = Program(process)
        environment = {**environment_of_programs(), "BOT_CONSOLE_SOCKET_DIR": self._folder}  # differs for each test
        process.start(argv, environment, started.write)
        return started


class Terminals:
    """A workspace with the page's package, terminals in it, and one console that all tests of a module share."""

    def __init__(self, workspace: Path) -> None:
        self.workspace = workspace
        assert not join_domain()
        self.system = LiveSystem()
        self.programs: list[Program] = []
        self.console = RosConsole()
        self.console.start()
        assert self.console.wait_ready(TIMEOUT_S)

    def start(self, command: str) -> Program:
        """Type a `ros2` line into a separate terminal, where it keeps running."""
        self.programs.append(self.system.ros2(*command.split()[1:]))
        return self.programs[-1]

    def ask(self, command: str) -> Program:
        """Type a `ros2` line into another terminal and wait for its end."""
        return self.system.finish(self.start(command))

    def node(self, text: str) -> Program:
        """Start a node that the page leaves as an exercise."""
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
                assert app.controls.faults.seen == [], "a pane has failed"

        with at_rest():
            asyncio.run(main())


@contextmanager
def terminals(folder: Path) -> Iterator[Terminals]:
    """The page's workspace and its terminals; all programs end when the block is left."""
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
        close_shared_buses()
        choose_middleware(local_bus)
        let_children_meet(False)
        uninstall_virtual_process()
