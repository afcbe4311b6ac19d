"""`python -m bot_console.tui`: the same as `bot-console`."""

from bot_console.tui.cli.entry import program

program()
