"""Output of a process on standard output."""

from __future__ import annotations

from launch.events.process.process_io import ProcessIO


class ProcessStdout(ProcessIO):
    """Bytes that a process has written to its standard output."""

    name = "launch.events.process.ProcessStdout"

    def __init__(self, *, text: bytes, **kwargs: object) -> None:
        super().__init__(text=text, fd=1, **kwargs)
