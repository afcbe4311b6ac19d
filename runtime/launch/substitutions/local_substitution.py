"""Locals of a launch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LocalSubstitution(Substitution):
    """An attribute of the launch's locals, such as `event.reason`."""

    def __init__(self, expression: str, description: str | None = None) -> None:
        super().__init__()
        self.__expression = expression
        self.__description = description

    @property
    def expression(self) -> str:
        """The attribute's path."""
        return self.__expression

    def describe(self) -> str:
        """Return a description such as `LocalVar('node name')`."""
        return f"LocalVar('{self.__expression if self.__description is None else self.__description}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the value; raises `AttributeError` if it is missing."""
        return str(eval(f"context.locals.{self.__expression}", {}, {"context": context}))
