"""Resetting the environment to that of the launch's start."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


@expose_action("reset_env")
class ResetEnvironment(Action):
    """Resets the environment to that of the launch's start."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ResetEnvironment], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Reset the environment."""
        context._reset_environment()  # pyright: ignore[reportPrivateUsage] -- there for this action, as upstream
