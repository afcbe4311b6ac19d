"""The services that panes get: all of them, or with `--read-only` wrappers that change nothing."""

from __future__ import annotations

from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.connection.read_only import ReadOnlyCommandLine, ReadOnlyConsole, ReadOnlyLauncher
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.console.model import Severity
from bot_console.tui.console.protocol import Console, Launcher


def for_panes(
    console: RosConsole, launcher: Launcher | None, lines: CommandLine, *, read_only: bool
) -> tuple[Console, Launcher | None, CommandLine]:
    """These three, or read-only wrappers around them."""
    if not read_only:
        return console, launcher, lines

    def report(text: str) -> None:
        console.printed(Severity.WARN, "bot-console", text)

    return ReadOnlyConsole(console, report), ReadOnlyLauncher(), ReadOnlyCommandLine(lines)
