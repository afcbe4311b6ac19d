"""The environment as it was at first."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.frontend import expose_action


@expose_action("reset_env")
class ResetEnvironment(Action):
    """Makes the environment what it was when the launch began."""

    @classmethod
    def parse(cls, entity: Any, parser: Any) -> tuple[type[ResetEnvironment], dict[str, Any]]:
        """From XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs

    def execute(self, context: Any) -> None:
        """Put it back."""
        context._reset_environment()
