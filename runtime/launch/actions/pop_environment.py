"""Restoring the saved environment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PopEnvironment(Action):
    """Restores the environment that was saved last."""

    def execute(self, context: LaunchContext) -> None:
        """Restore the environment."""
        context._pop_environment()  # pyright: ignore[reportPrivateUsage] -- there for this action, as upstream
