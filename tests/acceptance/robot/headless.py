"""A headless run of the installed command, as a user types it."""

from __future__ import annotations

import json
import os
from typing import Any

from processes.command_line import run_cli

TIMEOUT_S = 900.0
"""Seconds after which a test gives up; nothing is measured by it."""


def headless(folder: Any, *words: str, command: tuple[str, ...] = ()) -> dict[str, Any]:
    """Run `bot-console [COMMAND] --headless --fast WORDS` in a folder; return its report, with the log under `log`."""
    environment = {**os.environ, "ROS_HOME": str(folder)}
    done = run_cli(*command, "--headless", "--fast", *words, cwd=folder, env=environment)
    assert done.returncode == 0, done.stderr[-3000:]
    report: dict[str, Any] = json.loads(done.stdout)
    report["log"] = done.stderr
    return report
