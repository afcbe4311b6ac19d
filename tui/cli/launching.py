"""One running launch, as a node process: what it prints goes to the log, not to the screen."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from bot_console.runtime.process import NodeProcess
from bot_console.tui.console.launch.output import marking
from bot_console.tui.console.model import Severity

ENVIRONMENT = {"OVERRIDE_LAUNCH_PROCESS_OUTPUT": "own_log"}
"""Launch does not repeat on its screen what processes print, since the console reads that from launch's events."""

LAUNCH_LINE = re.compile(r"\[([A-Z]+)\] \[([^\]]+)\]: (.*)")
LEVELS = {"DEBUG": Severity.DEBUG, "WARNING": Severity.WARN, "ERROR": Severity.ERROR, "CRITICAL": Severity.FATAL}


class Launching:
    """One running launch."""

    def __init__(
        self, target: Callable[[], None], printed: Callable[[int, str, str], None], env: Mapping[str, str]
    ) -> None:
        self._process = NodeProcess("launch")

        def tell(text: str) -> None:
            line = LAUNCH_LINE.match(text)
            if line:
                printed(LEVELS.get(line[1], Severity.INFO), line[2], line[3])
            elif text.strip():
                printed(Severity.INFO, "launch", text.rstrip("\n"))

        self._process.start(target, env={**env, **ENVIRONMENT, **marking(env)}, stdout=tell, stderr=tell)

    def join(self, timeout: float | None = None) -> object:
        """Wait for the end, at most so many seconds."""
        return self._process.wait(timeout)
