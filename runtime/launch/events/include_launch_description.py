"""A request to include a launch description."""

from __future__ import annotations

from typing import Any

from launch.event import Event


class IncludeLaunchDescription(Event):
    """A launch description shall run in the launch."""

    name = "launch.events.IncludeLaunchDescription"

    def __init__(self, launch_description: Any) -> None:
        self.launch_description = launch_description
