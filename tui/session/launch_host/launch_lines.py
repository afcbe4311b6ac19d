"""Converts the messages of launch itself to log lines."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from bot_console.tui.console.launch.process_output import marking_variables
from bot_console.tui.console.model import Severity

OVERRIDE = {"OVERRIDE_LAUNCH_PROCESS_OUTPUT": "own_log"}
"""Keeps launch from repeating the output of processes, which the console takes from launch's events."""

LAUNCH_LINE = re.compile(r"\[([A-Z]+)\] \[([^\]]+)\]: (.*)")
LEVELS = {"DEBUG": Severity.DEBUG, "WARNING": Severity.WARN, "ERROR": Severity.ERROR, "CRITICAL": Severity.FATAL}


def launch_variables(environment: Mapping[str, str]) -> dict[str, str]:
    """An environment in which launch writes in the format parsed here."""
    return {**environment, **OVERRIDE, **marking_variables(environment)}


def notifier(printed: Callable[[int, str, str], None]) -> Callable[[str], None]:
    """A callback that logs lines which launch has printed."""

    def report(text: str) -> None:
        line = LAUNCH_LINE.match(text)
        if line:
            printed(LEVELS.get(line[1], Severity.INFO), line[2], line[3])
        elif text.strip():
            printed(Severity.INFO, "launch", text.rstrip("\n"))

    return report
