"""The services that panes get, with the console's gate in front of all of them."""

from __future__ import annotations

from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.gated_lines import GatedLines
from bot_console.tui.console.launch.gated_launcher import GatedLauncher
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.ros_console import RosConsole


def for_panes(
    console: RosConsole, launcher: Launcher | None, lines: CommandLine, *, read_only: bool
) -> tuple[RosConsole, Launcher | None, CommandLine]:
    """The console, the launcher and the command line; with `read_only` they change nothing from now on."""
    if read_only:
        console.refuse_changes()
    return console, launcher and GatedLauncher(console.gate, launcher), GatedLines(console.gate, lines)
