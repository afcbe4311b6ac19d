"""`EnableRmwIsolation`: a domain of its own for a test."""

from __future__ import annotations

from typing import Any

from launch.action import Action


class EnableRmwIsolation(Action):
    """Does nothing here: what a test launches runs in the domain of its process, which meets nobody by itself."""

    def execute(self, context: Any) -> None:
        """Nothing."""
