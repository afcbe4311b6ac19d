"""What the processes of a test have written."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

from launch_testing.asserts.texts import matcher
from launch_testing.processes import NoMatchingProcessException, resolve


class IoHandler:
    """Keeps all output, by process and in its order."""

    def __init__(self) -> None:
        self._sequence: list[Any] = []

    def track(self, action: Any) -> None:
        """Upstream's way to announce a process; here all are known when they write."""

    def append(self, process_io: Any) -> None:
        """Keep one more piece."""
        self._sequence.append(process_io)

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._sequence))

    def processes(self) -> list[Any]:
        """The processes that have written something."""
        return list(dict.fromkeys(each.action for each in self))

    process_names = property(lambda self: [each.process_name for each in self])

    def __getitem__(self, process: Any) -> list[Any]:
        (action,) = resolve(self.processes(), process)
        return [each for each in self if each.action is action]


class ActiveIoHandler(IoHandler):
    """The same while processes run; tests may wait for output."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = threading.Condition()

    @property
    def io_event(self) -> threading.Condition:
        """Is notified of each new piece."""
        return self._changed

    def append(self, process_io: Any) -> None:
        """Keep one more piece, and tell those who wait."""
        with self._changed:
            super().append(process_io)
            self._changed.notify_all()

    def waitFor(
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        *,
        output_filter: Callable[[str], str] | None = None,
        timeout: float = 10,
        strict_proc_matching: bool = True,
        stream: str = "stderr",
    ) -> bool:
        """Whether a process writes a text, or a line that matches, within so many seconds."""
        found = matcher(expected_output)

        def written() -> bool:
            known = self.processes()
            if process is not None or cmd_args is not None:
                try:
                    known = resolve(known, process, cmd_args, strict_proc_matching)
                except NoMatchingProcessException:
                    return False  # not started yet
            return any(found(_text(self, action, stream, output_filter)) for action in known)

        with self._changed:
            return self._changed.wait_for(written, timeout)

    def assertWaitFor(self, expected_output: Any, *args: Any, timeout: float = 10, **kwargs: Any) -> None:
        """Assert `waitFor`."""
        assert self.waitFor(expected_output, *args, timeout=timeout, **kwargs), (
            f"Waiting for output timed out: {expected_output!r} was not found within {timeout} s"
        )


def _text(handler: IoHandler, action: Any, stream: str, output_filter: Callable[[str], str] | None) -> str:
    pieces = (
        each
        for each in handler
        if each.action is action and (stream == "both" or each.from_stderr == (stream == "stderr"))
    )
    text = "".join(each.text.decode(errors="replace") for each in pieces)
    return output_filter(text) if output_filter else text
