"""The output of the processes of a test."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from launch_testing.asserts.output import assertInStream
from launch_testing.util import NoMatchingProcessException, resolveProcesses

if TYPE_CHECKING:
    from launch.action import Action
    from launch.events.process import ProcessIO


class IoHandler:
    """Keeps all output, by process and in order."""

    def __init__(self) -> None:
        self._sequence: list[ProcessIO] = []
        self._by_name: dict[str, list[ProcessIO]] = {}

    def track(self, process_name: str) -> None:
        """Register a process, which has no output yet."""
        self._by_name.setdefault(process_name, [])

    def append(self, process_io: ProcessIO) -> None:
        """Add a chunk of output."""
        self._sequence.append(process_io)
        self._by_name.setdefault(process_io.process_name, []).append(process_io)

    def __iter__(self) -> Iterator[ProcessIO]:
        return iter(list(self._sequence))

    def processes(self) -> list[Action]:
        """Return the processes that have written something."""
        return [pieces[0].action for pieces in list(self._by_name.values()) if pieces]

    def process_names(self) -> list[str]:
        """Return the names of all known processes."""
        return list(self._by_name)

    def __getitem__(self, process: Any) -> list[ProcessIO]:
        """Return the output of a process, by its action or its full name; raises `KeyError` for an unknown one."""
        name = process if isinstance(process, str) else process.process_details["name"]
        return list(self._by_name[name])


class ActiveIoHandler(IoHandler):
    """An `IoHandler` for running processes; tests may wait for output."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = threading.Condition()

    @property
    def io_event(self) -> threading.Condition:
        """The condition that is notified of each new chunk."""
        return self._changed

    def track(self, process_name: str) -> None:
        """Register a process, which has no output yet."""
        with self._changed:
            super().track(process_name)

    def append(self, process_io: ProcessIO) -> None:
        """Add a chunk, and notify the waiting threads."""
        with self._changed:
            super().append(process_io)
            self._changed.notify_all()

    def waitFor(
        self,
        expected_output: object,
        process: object = None,
        cmd_args: object = None,
        *,
        strict_proc_matching: bool = True,
        output_filter: Callable[[str], str] | None = None,
        timeout: float = 10,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> bool:
        """Return whether a process writes something to a stream within this many seconds.

        Raises `NoMatchingProcessException` if no matching process has written anything by then.
        """

        def written() -> bool:
            try:
                assertInStream(
                    self, expected_output, process, cmd_args,
                    output_filter=output_filter, strict_proc_matching=strict_proc_matching,
                    strip_ansi_escape_sequences=strip_ansi_escape_sequences, stream=stream,
                )  # fmt: skip
            except (NoMatchingProcessException, AssertionError):
                return False
            return True

        with self._changed:
            so = self._changed.wait_for(written, timeout)
            if not so:
                resolveProcesses(self, process=process, cmd_args=cmd_args, strict_proc_matching=False)
        return so

    def assertWaitFor(self, expected_output: object, *args: object, timeout: float = 10, **kwargs: object) -> None:
        """Assert that `waitFor` succeeds."""
        place = f"{kwargs.get('stream', 'stderr')} within {timeout} s"
        assert self.waitFor(expected_output, *args, timeout=timeout, **kwargs), (
            f"Waiting for output timed out: {expected_output!r} was not found in {place}"
        )
