"""Conditions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Condition:
    """A predicate over a context."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate
        self.__last: bool | None = None

    def describe(self) -> str:
        """Return a short description."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """Evaluate the condition in a context; False if there is no predicate."""
        self.__last = self._predicate(context) if self._predicate is not None else False
        return self.__last
