"""Substitutions."""

from __future__ import annotations

from typing import Any


class Substitution:
    """A text that is known only when the launch runs."""

    def describe(self) -> str:
        """A short text for people."""
        return self.__repr__()

    def perform(self, context: Any) -> str:
        """The text."""
        return ""
