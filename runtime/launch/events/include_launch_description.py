"""A request to include a launch description."""

from __future__ import annotations

from launch.event import Event


class IncludeLaunchDescription(Event):
    """Requests that a launch description be included."""

    name = "launch.events.IncludeLaunchDescription"

    def __init__(self, launch_description: object) -> None:
        self.launch_description = launch_description
