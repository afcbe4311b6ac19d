"""Checks that a screen can be drawn on this terminal; if not, a text says what to do instead."""

from __future__ import annotations

import os
import sys

NO_TERMINAL = """\
bot-console needs a terminal, and its input or output is not one. Without a terminal:
  bot-console --headless --duration 60   run the robot for a minute and print a report
  bot-console up                         start the robot in the background; see also status and down
  ssh -t HOST bot-console                open the console on another machine"""
NO_TERMINAL_TO_ATTACH = "bot-console needs a terminal; without one, use `bot-console doctor` or the `ros2` commands"
DUMB = (
    "TERM=dumb says that this terminal cannot move its cursor, so the console cannot be drawn. If it can:\n"
    "  export TERM=xterm-256color"
)


def terminal_problem(no_terminal: str = NO_TERMINAL) -> str:
    """Return why no console can be shown here, and what to do; empty if it can. `no_terminal` is the first reason."""
    if not (sys.stdout.isatty() and sys.stdin.isatty()):
        return no_terminal
    return DUMB if os.environ.get("TERM") == "dumb" else ""
