"""Saving the environment."""

from __future__ import annotations

from typing import Any

from launch.action import Action


class PushEnvironment(Action):
    """Saves the environment, for a later `PopEnvironment`."""

    def execute(self, context: Any) -> None:
        """Save it."""
        context._push_environment()
