"""What a console's panes are given: all that a person may do, or with `--read-only` what only looks on."""

from __future__ import annotations

from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.connection.read_only import ReadOnlyCommandLine, ReadOnlyConsole, ReadOnlyLauncher
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.console.model import Severity
from bot_console.tui.console.protocol import Console, Launcher


def for_panes(
    console: RosConsole, launcher: Launcher | None, lines: CommandLine, *, read_only: bool
) -> tuple[Console, Launcher | None, CommandLine]:
    """These three, or what stands before them and refuses."""
    if not read_only:
        return console, launcher, lines

    def tell(text: str) -> None:
        console.printed(Severity.WARN, "bot-console", text)

    return ReadOnlyConsole(console, tell), ReadOnlyLauncher(), ReadOnlyCommandLine(lines)
