"""Substitutions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Substitution:
    """A text that is known only when the launch runs."""

    def describe(self) -> str:
        """A short text for people."""
        return self.__repr__()

    def perform(self, context: LaunchContext) -> str:
        """The text."""
        return ""
