"""Where the commands of a ROS installation are, and which program each of them runs."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

BIN = Path(__file__).resolve().parent / "bin"
"""`ros2` and `colcon` in `ros2/`, the programs of rqt in `rqt/`, `bot-console` in `bot_console/`.

They are files because scripts, `timeout` and `watch` do not find shell functions.
"""

COMMAND_VARIABLE = "BOT_CONSOLE_COMMAND"
"""The `bot-console` that these commands run, whichever environment is active where they are called."""


def command() -> str:
    """Return the path of the `bot-console` that belongs to this program."""
    called = sys.argv[0] if os.path.basename(sys.argv[0]) == "bot-console" else ""
    beside = os.path.join(os.path.dirname(sys.executable), "bot-console")
    if called:
        found = shutil.which(called)
    elif os.access(beside, os.X_OK):
        found = beside
    else:
        found = shutil.which("bot-console")
    return os.path.abspath(found or beside)
