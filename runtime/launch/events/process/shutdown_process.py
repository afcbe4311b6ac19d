"""A request to shut a process down."""

from __future__ import annotations

from launch.events.process.process_targeted_event import ProcessTargetedEvent


class ShutdownProcess(ProcessTargetedEvent):
    """Requests that a process end: by SIGINT, then by stronger signals if it does not."""

    name = "launch.events.process.ShutdownProcess"
