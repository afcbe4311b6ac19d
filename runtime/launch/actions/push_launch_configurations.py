"""Saving the launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PushLaunchConfigurations(Action):
    """Saves the launch configurations, for a later `PopLaunchConfigurations`."""

    def execute(self, context: LaunchContext) -> None:
        """Save the configurations."""
        context._push_launch_configurations()  # pyright: ignore[reportPrivateUsage] -- there for this action, as upstream
