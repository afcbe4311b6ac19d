"""Setting a launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.expose import expose_action
from launch.named_value import NamedValue
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("let")
class SetLaunchConfiguration(NamedValue):
    """Sets a launch configuration."""

    def execute(self, context: LaunchContext) -> None:
        """Set the configuration."""
        name = perform_substitutions(context, self.name)
        context.launch_configurations[name] = perform_substitutions(context, self.value)
