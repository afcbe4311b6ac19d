"""A deprecated condition on the value of one launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.conditions.launch_configuration_equals import LaunchConfigurationEquals

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """True if a launch configuration does not have a given value."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)
