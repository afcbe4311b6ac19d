"""`EnableRmwIsolation`: a separate domain for a test."""

from __future__ import annotations

from launch.action import Action


class EnableRmwIsolation(Action):
    """Does nothing here, as a test's launch runs in the domain of its process, which is isolated by default."""

    def execute(self, context: object) -> None:
        """Do nothing."""
