"""Old condition over one launch configuration."""

from __future__ import annotations

from typing import Any

from launch.conditions.launch_configuration_equals import LaunchConfigurationEquals


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Holds when a launch configuration does not have a value."""

    def _predicate_func(self, context: Any) -> bool:
        return not super()._predicate_func(context)
