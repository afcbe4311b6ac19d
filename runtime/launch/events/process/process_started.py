"""A process has started."""

from __future__ import annotations

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessStarted(RunningProcessEvent):
    """A process has been started."""

    name = "launch.events.process.ProcessStarted"
