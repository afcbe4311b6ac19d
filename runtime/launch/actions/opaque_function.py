"""Calling a Python function."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, cast

from launch.action import Action
from launch.utilities import ensure_argument_type

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity


class OpaqueFunction(Action):
    """Calls a function with the context, and visits the entities it returns."""

    def __init__(
        self,
        *,
        function: Callable[..., Sequence[LaunchDescriptionEntity] | None],
        args: Iterable[object] | None = None,
        kwargs: Mapping[str, object] | None = None,
        **left_over_kwargs: Condition | None,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            raise TypeError(f"OpaqueFunction expected a callable for 'function', got '{type(function)}'")
        ensure_argument_type(args, (Iterable, type(None)), "args", "OpaqueFunction")
        ensure_argument_type(kwargs, (dict, type(None)), "kwargs", "OpaqueFunction")
        self.__function = function
        self.__args = () if args is None else args
        self.__kwargs: Mapping[str, object] = {} if kwargs is None else kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Call the function and return its entities."""
        entities = self.__function(context, *self.__args, **self.__kwargs)
        return cast("list[LaunchDescriptionEntity] | None", entities)
