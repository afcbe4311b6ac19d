"""Restoring the saved launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PopLaunchConfigurations(Action):
    """Restores the launch configurations that were saved last."""

    def execute(self, context: LaunchContext) -> None:
        """Restore the configurations."""
        context._pop_launch_configurations()  # pyright: ignore[reportPrivateUsage] -- there for this action, as upstream
