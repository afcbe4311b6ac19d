"""Output of a process on standard error."""

from __future__ import annotations

from launch.events.process.process_io import ProcessIO


class ProcessStderr(ProcessIO):
    """Bytes that a process has written to its standard error."""

    name = "launch.events.process.ProcessStderr"

    def __init__(self, *, text: bytes, **kwargs: object) -> None:
        super().__init__(text=text, fd=2, **kwargs)
