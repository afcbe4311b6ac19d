"""Saving the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PushEnvironment(Action):
    """Saves the environment, for a later `PopEnvironment`."""

    def execute(self, context: LaunchContext) -> None:
        """Save the environment."""
        context._push_environment()  # pyright: ignore[reportPrivateUsage] -- there for this action, as upstream
