"""A node was left out because its executable is missing."""

from __future__ import annotations

from launch.event import Event


class NodeMissing(Event):
    """The action that was not started, its package and executable, and how to get them; ROS 2 has no such event."""

    name = "launch_ros.events.NodeMissing"

    def __init__(self, *, action: object, package: str, executable: str, reason: str) -> None:
        self.action = action
        self.package = package
        self.executable = executable
        self.reason = reason
