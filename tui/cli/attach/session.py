"""A console session on a system that it did not start, and that continues after it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

from bot_console.tui.app import BotConsoleApp
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.hang_watch import HangWatch, hang_watch
from bot_console.tui.cli.interpreter import collect_from_now_on, eager_switching
from bot_console.tui.cli.live.descriptors import own_terminal
from bot_console.tui.cli.live.ending_signals import ended_by_signals, hangup_as_signal
from bot_console.tui.cli.live.for_panes import for_panes
from bot_console.tui.cli.look import look_of
from bot_console.tui.cli.system.plugins import find_plugins
from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.console.model import Severity
from bot_console.tui.console.protocol import Launcher
from bot_console.tui.files.folders import state_folder

READY = 20.0


class AttachedSession:
    """Console, app and terminal."""

    def __init__(
        self,
        console: RosConsole,
        command_line: CommandLine,
        options: Options,
        *,
        launcher: Launcher | None = None,
        said: Sequence[tuple[Severity, str]] = (),
        on_first_frame: Callable[[], None] = lambda: None,
        on_close: Callable[[], None] = lambda: None,
    ) -> None:
        """`said` are lines for the log; `on_close` ends what was started with the console, before that leaves."""
        self._console = console
        self._said = said
        self._first_frame = on_first_frame
        self._on_close = on_close
        self._has_begun: Callable[[], None] = lambda: None
        self._hang_watch: HangWatch | None = None
        look = look_of(options)
        self.app = BotConsoleApp(
            *for_panes(console, launcher, command_line, read_only=options.read_only),
            opening=options.opening._replace(notes=(*options.opening.notes, *look.notes)),
            on_first_frame=self._on_first_frame,
            look=look,
            plugins=find_plugins,
        )

    def run(self) -> int:
        """Show the console until it quits. A robot that it steers is left standing; everything else goes on."""
        with (
            own_terminal(self._console.printed) as watch,
            ended_by_signals(self._end),
            hangup_as_signal(),
            eager_switching(),
            hang_watch(state_folder(), self.app.how_it_draws, self._stood) as self._hang_watch,
        ):
            self._has_begun = watch.has_begun
            try:
                self.app.run()
                watch.has_ended()
            finally:
                if self._hang_watch is not None:
                    self._hang_watch.rest()
                self.app.stage.arrangement.remember()
                self._on_close()
                self._console.close()
        return self.app.return_code or 0

    def _on_first_frame(self) -> None:
        self._has_begun()
        if self._hang_watch is not None:
            self._hang_watch.accompany(self.app)
        self._first_frame()
        collect_from_now_on()
        self._console.start()
        threading.Thread(target=self._tell, name="start", daemon=True).start()

    def _stood(self, line: str) -> None:
        self._console.printed(Severity.WARN, "bot-console", line)

    def _tell(self) -> None:
        if self._console.wait_ready(READY):
            for severity, line in self._said:
                self._console.printed(severity, "bot-console", line)

    def _end(self, number: int) -> None:
        """End the app as `q` does, on SIGINT, SIGTERM and SIGHUP."""
        self.app.exit(return_code=128 + number)
