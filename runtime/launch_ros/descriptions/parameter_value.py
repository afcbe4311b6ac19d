"""A value with a type."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class ParameterValue:
    """A parameter's value, or substitutions whose text is converted to a type, or if that is None, by YAML's rules."""

    def __init__(self, value: object, *, value_type: object = None) -> None:
        self.__value = normalize_typed_substitution(value, value_type)
        self.__value_type = value_type
        self.__evaluated: Any = None

    @property
    def value(self) -> Any:
        """The value; evaluated when the launch runs."""
        return self.__value if self.__evaluated is None else self.__evaluated

    @property
    def given(self) -> Any:
        """The value as it was given, normalized (not upstream)."""
        return self.__value

    @property
    def value_type(self) -> Any:
        """The type."""
        return self.__value_type

    def __str__(self) -> str:
        return f"launch_ros.description.ParameterValue(value={self.value}, value_type={self.value_type})"

    def evaluate(self, context: LaunchContext) -> Any:
        """Return the value, evaluated on the first call; raises `ValueError` if a text does not have the type."""
        self.__evaluated = perform_typed_substitution(context, self.value, self.__value_type)
        return self.__evaluated
