"""A console session with a launched system: the app, the system, and how both end."""

from __future__ import annotations

import signal
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement.startup import System
from bot_console.tui.cli.appearance import appearance_of
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.foreground.foreground import Foreground
from bot_console.tui.cli.interpreter import resume_collection
from bot_console.tui.cli.slow_exit import report_slow_exit
from bot_console.tui.pane_table import PaneEntry

if TYPE_CHECKING:
    from bot_console.tui.console.ros_console import RosConsole
    from bot_console.tui.session.connected import ConnectedParts
    from bot_console.tui.session.protocol import ClosableLauncher


class Session:
    """The app and, once connected, the console and the launched system."""

    def __init__(self, options: Options, connect: Callable[[], ConnectedParts] | None = None) -> None:
        """`connect` makes the console and its launcher, by default in this process; called after the first frame."""
        self._options = options
        self._connect = connect or self._embedded
        self._closed = False
        appearance = appearance_of(options)
        self.app = BotConsoleApp(
            reach=self._reach,
            opening=options.opening._replace(notes=(*options.opening.notes, *appearance.notes)),
            on_first_frame=resume_collection,
            appearance=appearance,
            plugins=self._plugins,
        )
        self._foreground = Foreground(self.app, self._printed, self._end, self._steers)

    @cached_property
    def connected(self) -> ConnectedParts:
        """The console and what it has started; created on first use."""
        return self._connect()

    @property
    def console(self) -> RosConsole:
        """The console of the session."""
        return self.connected.console

    @property
    def launcher(self) -> ClosableLauncher:
        """The launcher that starts processes."""
        return self.connected.launcher

    def _embedded(self) -> ConnectedParts:
        from bot_console.tui.session.connected import ConnectedParts

        return ConnectedParts(self._options)

    def _reach(self) -> System:
        self._foreground.begin()
        self.app.tuner = self.connected.tuner
        return self.connected.begin()

    def _plugins(self) -> Sequence[PaneEntry]:
        return [*self._options.extra_panes, *self.connected.plugins()]

    def _is_connected(self) -> bool:
        return "connected" in self.__dict__

    def _steers(self) -> bool:
        return self._is_connected() and self.console.drive.steers

    def _printed(self, severity: int, label: str, text: str) -> None:
        if self._is_connected():  # before that, nobody reads the log
            self.console.printed(severity, label, text)

    def run(self) -> int:
        """Show the console until it is quit; the robot stands still when this returns, however the console ended."""
        return self._foreground.run(self._close_reporting)

    def _close_reporting(self) -> None:
        with report_slow_exit():
            self.close()

    def _end(self, number: int) -> None:
        """Stop the robot, then end the app: on a SIGINT from outside, SIGTERM or SIGHUP (a closed terminal)."""
        try:
            if not self._options.attach and self._is_connected():
                self.console.drive.stop(True, f"bot-console was ended by {signal.Signals(number).name}")
        finally:
            self.app.exit(return_code=128 + number)

    def close(self) -> None:
        """Send zero velocity, end the launched processes, then leave the graph; a second call does nothing.

        A robot that this console only attached to keeps running. If this console steers it, leaving the graph locks it.
        """
        if not self._closed and self._is_connected():
            self.connected.close()
        self._closed = True
