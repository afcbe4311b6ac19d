"""One running launch, as a node process: its output goes to the log, not to the screen."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from bot_console.runtime.process import NodeProcess
from bot_console.tui.session.launch_lines import launch_variables, notifier


class Launching:
    """One running launch."""

    def __init__(
        self, target: Callable[[], None], printed: Callable[[int, str, str], None], env: Mapping[str, str]
    ) -> None:
        self._process = NodeProcess("launch")
        report = notifier(printed)
        self._process.start(target, env=launch_variables(env), stdout=report, stderr=report)

    def join(self, timeout: float | None = None) -> object:
        """Wait for the end, at most `timeout` seconds."""
        return self._process.wait(timeout)
