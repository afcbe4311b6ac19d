"""A console session on a system that it did not start and that outlives it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

from bot_console.tui.app import BotConsoleApp
from bot_console.tui.cli.appearance import appearance_of
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.foreground.foreground import Foreground
from bot_console.tui.cli.interpreter import resume_collection
from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.model import Severity
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.plugins import find_plugins

READY_TIMEOUT_S = 20.0


class AttachedSession:
    """The console and the app of an attached session."""

    def __init__(
        self,
        console: RosConsole,
        command_line: CommandLine,
        options: Options,
        *,
        message: Sequence[tuple[Severity, str]] = (),
        on_first_frame: Callable[[], None] = lambda: None,
        on_close: Callable[[], None] = lambda: None,
    ) -> None:
        """`message` are lines for the log; `on_close` ends what was started with the console, before it leaves."""
        self._console = console
        self._last_message = message
        self._first_frame = on_first_frame
        self._on_close = on_close
        if options.read_only:
            console.refuse_changes()
        appearance = appearance_of(options)
        self.app = BotConsoleApp(
            console,
            command_line,
            opening=options.opening._replace(notes=(*options.opening.notes, *appearance.notes)),
            on_first_frame=self._on_first_frame,
            appearance=appearance,
            plugins=find_plugins,
        )
        self._foreground = Foreground(self.app, console.printed, self._end, lambda: console.drive.steers)

    def run(self) -> int:
        """Show the console until it is quit. It stops the robot if it steers it; everything else keeps running."""
        return self._foreground.run(self._close)

    def _close(self) -> None:
        self._on_close()
        self._console.close()

    def _on_first_frame(self) -> None:
        self._foreground.begin()
        self._first_frame()
        resume_collection()
        self._console.start()
        threading.Thread(target=self._report, name="start", daemon=True).start()

    def _report(self) -> None:
        if self._console.wait_ready(READY_TIMEOUT_S):
            for severity, line in self._last_message:
                self._console.printed(severity, "bot-console", line)

    def _end(self, number: int) -> None:
        """End the app as `q` does, on SIGINT, SIGTERM and SIGHUP."""
        self.app.exit(return_code=128 + number)
