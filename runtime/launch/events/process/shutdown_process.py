"""A request to shut a process down."""

from __future__ import annotations

from launch.events.process.process_targeted_event import ProcessTargetedEvent


class ShutdownProcess(ProcessTargetedEvent):
    """A process shall end: SIGINT first, stronger signals when that does not help."""

    name = "launch.events.process.ShutdownProcess"
