"""Taking a saved environment back."""

from __future__ import annotations

from typing import Any

from launch.action import Action


class PopEnvironment(Action):
    """Takes the environment back that was saved last."""

    def execute(self, context: Any) -> None:
        """Take it back."""
        context._pop_environment()
