"""Runs the app in the foreground of this terminal: its descriptors, its signals, and the watch for hangs."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.app import BotConsoleApp
from bot_console.tui.cli.foreground.browser_watch import browser_watch
from bot_console.tui.cli.foreground.descriptors import Printed, captured_descriptors
from bot_console.tui.cli.foreground.ending_signals import ended_by_signals, hangup_as_signal
from bot_console.tui.cli.foreground.hang_watch import HangWatch, hang_watch
from bot_console.tui.cli.interpreter import eager_switching
from bot_console.tui.console.model import Severity
from bot_console.tui.files.folders import state_folder


class Foreground:
    """Shows an app, and restores the terminal afterwards."""

    def __init__(
        self, app: BotConsoleApp, printed: Printed, end: Callable[[int], None], steers: Callable[[], bool]
    ) -> None:
        """`printed` receives lines for the log, `end` the number of a signal that ends the app.

        `steers` may be called in any thread, and returns whether a person steers a robot from here.
        """
        self._steers = steers
        self._app = app
        self._printed = printed
        self._end = end
        self._hang_watch: HangWatch | None = None

    def begin(self) -> None:
        """Start watching for hangs, since the app has drawn its first frame."""
        if self._hang_watch is not None:
            self._hang_watch.watch_app(self._app)

    def run(self, close: Callable[[], None]) -> int:
        """Show the app until it ends, then call `close` to end the system; returns the app's exit code."""
        with (
            captured_descriptors(self._printed),
            ended_by_signals(self._end),
            hangup_as_signal(),
            browser_watch(self._steers),
            eager_switching(),
            hang_watch(state_folder(), self._app.how_it_draws, self._hung) as self._hang_watch,
        ):
            try:
                self._app.run()
            finally:
                if self._hang_watch is not None:
                    self._hang_watch.pause()
                self._app.stage.arrangement.remember()
                close()
        return self._app.return_code or 0

    def _hung(self, line: str) -> None:
        self._printed(Severity.WARN, "bot-console", line)
