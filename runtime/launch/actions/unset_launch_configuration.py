"""Unsetting a launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.named_value import Named
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class UnsetLaunchConfiguration(Named):
    """Unsets a launch configuration, if it is set."""

    def execute(self, context: LaunchContext) -> None:
        """Unset the configuration, if it is set."""
        context.launch_configurations.pop(perform_substitutions(context, self.name), None)
