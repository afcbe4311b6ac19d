"""Input for a process."""

from __future__ import annotations

from launch.events.process.process_io import ProcessIO


class ProcessStdin(ProcessIO):
    """Bytes for a process's standard input."""

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, **kwargs: object) -> None:
        super().__init__(text=text, fd=0, **kwargs)
