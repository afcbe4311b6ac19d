"""Unsetting an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.expose import expose_action
from launch.named_value import Named
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


@expose_action("unset_env")
class UnsetEnvironmentVariable(Named):
    """Unsets an environment variable for processes visited later."""

    def execute(self, context: LaunchContext) -> None:
        """Unset the variable, if it is set."""
        context.environment.pop(perform_substitutions(context, self.name), None)
