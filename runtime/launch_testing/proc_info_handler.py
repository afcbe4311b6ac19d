"""The starts and exits of the processes of a test."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

from launch.events.process import ProcessExited
from launch_testing.util.proc_lookup import NoMatchingProcessException, describe_process, resolveProcesses


class ProcInfoHandler:
    """Keeps the last event of each process: its start, then its exit."""

    def __init__(self) -> None:
        self._events: dict[Any, Any] = {}

    def append(self, process_info: Any) -> None:
        """Add a start or exit."""
        self._events[process_info.action] = process_info

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._events.values()))

    def processes(self) -> list[Any]:
        """Return the known processes."""
        return list(self._events)

    def process_names(self) -> list[str]:
        """Return the names of the known processes."""
        return [each.process_details["name"] for each in list(self._events)]

    def __getitem__(self, process: object) -> Any:
        """Return the event of a process, by its action or a part of its name; raises `KeyError` for an unknown one."""
        if not isinstance(process, str):
            return self._events[process]
        for action, event in list(self._events.items()):
            if process in action.process_details["name"]:
                return event
        raise KeyError(process)


class ActiveProcInfoHandler(ProcInfoHandler):
    """A `ProcInfoHandler` for running processes; tests may wait for starts and exits."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = threading.Condition()

    @property
    def proc_event(self) -> threading.Condition:
        """The condition that is notified of each start and exit."""
        return self._changed

    def append(self, process_info: object) -> None:
        """Add a start or exit, and notify the waiting threads."""
        with self._changed:
            super().append(process_info)
            self._changed.notify_all()

    def assertWaitForStartup(self, process: object, cmd_args: object = None, *, timeout: float = 10) -> None:
        """Assert that a process starts within this many seconds."""
        so = self._wait(process, cmd_args, timeout, lambda event: True)
        assert so, f"Timed out waiting for process '{_process_text(process)}' to start"

    def assertWaitForShutdown(self, process: object, cmd_args: object = None, *, timeout: float = 10) -> None:
        """Assert that a process ends within this many seconds."""
        so = self._wait(process, cmd_args, timeout, lambda event: isinstance(event, ProcessExited))
        assert so, f"Timed out waiting for process '{_process_text(process)}' to finish"

    def _wait(self, process: object, cmd_args: object, timeout: float, fits: Callable[[Any], bool]) -> bool:
        def so() -> bool:
            try:
                return fits(self._events[resolveProcesses(self, process=process, cmd_args=cmd_args)[0]])
            except NoMatchingProcessException:
                return False

        with self._changed:
            return self._changed.wait_for(so, timeout)


def _process_text(process: object) -> str | None:
    return process if isinstance(process, str) or process is None else describe_process(process)
