"""Substitutions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Substitution:
    """A text that is known only when the launch runs."""

    def describe(self) -> str:
        """Return a short description."""
        return self.__repr__()

    def perform(self, context: LaunchContext) -> str:
        """Evaluate to the text."""
        return ""
