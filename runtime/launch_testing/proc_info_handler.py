"""How the processes of a test have ended."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

from launch_testing.processes import NoMatchingProcessException, name_of, resolve


class ProcInfoHandler:
    """Keeps the exit of each process."""

    def __init__(self) -> None:
        self._exits: dict[Any, Any] = {}

    def append(self, process_info: Any) -> None:
        """Keep one more start or exit."""
        self._exits[process_info.action] = process_info

    def processes(self) -> list[Any]:
        """The processes that are known."""
        return list(self._exits)

    def process_names(self) -> list[str]:
        """Their names."""
        return [each.process_name for each in self._exits.values()]

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._exits.values()))

    def __getitem__(self, process: Any) -> Any:
        (action,) = resolve(self._exits, process)
        return self._exits[action]


class ActiveProcInfoHandler(ProcInfoHandler):
    """The same while processes run; tests may wait for starts and exits."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = threading.Condition()
        self._ended: set[Any] = set()

    def append(self, process_info: Any) -> None:
        """Keep one more start or exit, and tell those who wait."""
        with self._changed:
            super().append(process_info)
            if hasattr(process_info, "returncode"):
                self._ended.add(process_info.action)
            self._changed.notify_all()

    def assertWaitForStartup(self, process: Any, cmd_args: Any = None, *, timeout: float = 10) -> None:
        """Assert that a process starts within so many seconds."""
        assert self._wait(process, cmd_args, timeout, ended=False), (
            f"Timed out waiting for process '{_shown(process)}' to start"
        )

    def assertWaitForShutdown(self, process: Any, cmd_args: Any = None, *, timeout: float = 10) -> None:
        """Assert that a process ends within so many seconds."""
        assert self._wait(process, cmd_args, timeout, ended=True), (
            f"Timed out waiting for process '{_shown(process)}' to finish"
        )

    def _wait(self, process: Any, cmd_args: Any, timeout: float, *, ended: bool) -> bool:
        def so() -> bool:
            try:
                found = resolve(self._exits, process, cmd_args)
            except NoMatchingProcessException:
                return False
            return not ended or all(each in self._ended for each in found)

        with self._changed:
            return self._changed.wait_for(so, timeout)


def _shown(process: Any) -> str:
    return process if isinstance(process, str) else name_of(process)
