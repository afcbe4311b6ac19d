"""Saving the environment."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.frontend import expose_action


class PushEnvironment(Action):
    """Saves the environment, for a later `PopEnvironment`."""

    def execute(self, context: Any) -> None:
        """Save it."""
        context._push_environment()


class PopEnvironment(Action):
    """Takes the environment back that was saved last."""

    def execute(self, context: Any) -> None:
        """Take it back."""
        context._pop_environment()


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
