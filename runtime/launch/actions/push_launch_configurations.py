"""Saving the launch configurations."""

from __future__ import annotations

from typing import Any

from launch.action import Action


class PushLaunchConfigurations(Action):
    """Saves the launch configurations, for a later `PopLaunchConfigurations`."""

    def execute(self, context: Any) -> None:
        """Save them."""
        context._push_launch_configurations()
