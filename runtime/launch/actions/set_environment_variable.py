"""Setting an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.expose import expose_action
from launch.named_value import NamedValue
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("set_env")
class SetEnvironmentVariable(NamedValue):
    """Sets an environment variable for processes visited later."""

    def execute(self, context: LaunchContext) -> None:
        """Set the variable."""
        name = perform_substitutions(context, self.name)
        context.environment[name] = perform_substitutions(context, self.value)
