"""Hands the terminal to another program for a while: to an editor, or on Ctrl-Z to the shell.

The robot is stopped first.
"""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.tui.terminal.editor import editor_command
from textual.app import App, SuspendNotSupported

if TYPE_CHECKING:
    from bot_console.tui.console.protocol import Console

STOP_TIMEOUT_S = 1.0
"""Seconds within which the robot should acknowledge the stop; then the terminal is left anyway."""
STOP_POLL_S = 0.05
EMPTY = "\x1b[m\x1b[H\x1b[J"
ASLEEP = "bot-console was suspended (Ctrl-Z)"


class TerminalHandover:
    """Hands over the terminal and takes it back."""

    def __init__(self, app: App[None], console: Console, redraw: Callable[[], None], *, holds: bool) -> None:
        """`holds`: whether to hold the robot while the console is suspended; only a console that may release it may
        hold it.
        """
        self._app = app
        self._holds = holds
        self._console = console
        self._redraw = redraw
        self._going = False

    def edit(self, file: str, line: int) -> None:
        """Open a file at a line in the user's editor. Nothing is steered meanwhile: a command expires after 0.5 s."""
        try:
            command = editor_command(file, line, os.environ)
        except ValueError as error:
            self._app.notify(str(error), severity="error")
            return
        self.run(command)

    def run(self, command: Sequence[str]) -> int:
        """Hand the terminal to another program, and return its exit code. Nothing is steered meanwhile."""
        code = 0
        self._console.drive.move(0.0, 0.0)
        try:
            with self._app.suspend():
                # While the console runs, descriptors 0 to 2 refer to the log; these are the terminal.
                inward, outward, errors = sys.__stdin__, sys.__stdout__, sys.__stderr__
                code = subprocess.run(command, stdin=inward, stdout=outward, stderr=errors, check=False).returncode
        except SuspendNotSupported:
            self._app.notify("This terminal cannot be handed to another program.", severity="error")
        except OSError as error:
            self._app.notify(f"{command[0]}: {error.strerror or error}", severity="error")
        self._redraw()
        return code

    def sleep(self) -> None:
        """Hold the robot, and give the terminal back to the shell; `fg` brings the console back."""
        if self._going:
            return
        self._going = True
        if self._holds:
            self._console.drive.stop(True, ASLEEP)
        self._when_held(STOP_TIMEOUT_S if self._holds else 0.0)

    def _when_held(self, timeout_s: float) -> None:
        drive = self._console.snapshot().drive
        if timeout_s > 0 and (drive.lockable or drive.searching) and not drive.stop_confirmed:
            self._app.set_timer(STOP_POLL_S, lambda: self._when_held(timeout_s - STOP_POLL_S))
            return
        self._app.action_suspend_process()
        self._going = False
        if self._holds:
            self._app.notify("The robot was held meanwhile, and stays held.")
        self._redraw()


def resume_after_any_stop(driver: Any) -> None:
    """Let Textual's Linux driver continue after any suspension, even an unnoticed one (SIGSTOP, a debugger).

    Textual sets up the terminal at each SIGCONT. If the app has not left the terminal before, a second thread would
    then read keys alongside the first one: each would get some of them, and at the end the app would wait forever for
    the first. So this leaves the terminal first, from the event loop and not in the signal handler: the interrupted
    code may hold the lock of the output queue, for which the handler would wait forever.
    """
    set_up = driver.resume_application_mode
    loop = asyncio.get_running_loop()
    wanted, at_it = False, False

    def in_use() -> bool:
        return driver._writer_thread is not None and driver._writer_thread.is_alive()

    def renew() -> None:
        nonlocal wanted, at_it
        at_it = True
        try:
            while wanted:
                wanted = False
                if in_use():
                    driver.suspend_application_mode()
                set_up()
        finally:
            at_it = False

    def renew_if_in_use() -> None:
        nonlocal wanted
        if in_use():
            renew()
        else:  # left meanwhile
            wanted = False

    def resume() -> None:
        nonlocal wanted
        wanted = True
        if at_it:  # a SIGCONT during this one
            return
        if in_use():
            loop.call_soon_threadsafe(renew_if_in_use)
        else:
            renew()

    driver.resume_application_mode = resume


def clear_screen_before_leaving(driver: Any) -> None:
    """Make Textual's Linux driver clear the alternate screen before leaving it.

    If the terminal was enlarged meanwhile, tmux would move non-empty rows of it into the shell's screen.
    """
    leave = driver.stop_application_mode

    def stop() -> None:
        driver.write(EMPTY)
        leave()

    driver.stop_application_mode = stop
