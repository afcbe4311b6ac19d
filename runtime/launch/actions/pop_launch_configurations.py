"""Taking saved launch configurations back."""

from __future__ import annotations

from typing import Any

from launch.action import Action


class PopLaunchConfigurations(Action):
    """Takes the launch configurations back that were saved last."""

    def execute(self, context: Any) -> None:
        """Take them back."""
        context._pop_launch_configurations()
