"""A process has written output, or gets input."""

from __future__ import annotations

from typing import Any

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessIO(RunningProcessEvent):
    """Bytes from or to a process."""

    name = "launch.events.process.ProcessIO"

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__text = text
        self.__fd = fd

    @property
    def text(self) -> bytes:
        """The bytes."""
        return self.__text

    @property
    def from_stdin(self) -> bool:
        """Whether the bytes are input."""
        return self.__fd == 0

    @property
    def from_stdout(self) -> bool:
        """Whether the bytes are standard output."""
        return self.__fd == 1

    @property
    def from_stderr(self) -> bool:
        """Whether the bytes are standard error."""
        return self.__fd == 2
