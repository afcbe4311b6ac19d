"""A headless run of the installed command, as a user types it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import Any

TIMEOUT_S = 900.0
"""Seconds after which a test gives up; nothing is measured by it."""


def headless(folder: Any, *words: str, command: tuple[str, ...] = ()) -> dict[str, Any]:
    """The report of `bot-console [COMMAND] --headless --fast WORDS`, run in a folder; the log is under `log`."""
    line = [sys.executable, "-m", "bot_console.tui", *command, "--headless", "--fast", *words]
    environment = {**os.environ, "ROS_HOME": str(folder)}
    done = subprocess.run(
        line, cwd=folder, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    assert done.returncode == 0, done.stderr[-3000:]
    report: dict[str, Any] = json.loads(done.stdout)
    report["log"] = done.stderr
    return report
