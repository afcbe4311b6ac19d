"""Calling a Python function."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class OpaqueFunction(Action):
    """Calls a function with the context, and visits the entities it returns."""

    def __init__(
        self,
        *,
        function: Callable[..., Any],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        self.__function = function
        self.__args = () if args is None else args
        self.__kwargs = {} if kwargs is None else kwargs

    def execute(self, context: LaunchContext) -> Any:
        """Call the function and return its entities."""
        return self.__function(context, *self.__args, **self.__kwargs)
