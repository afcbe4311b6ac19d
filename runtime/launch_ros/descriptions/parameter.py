"""A parameter with its value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.descriptions.parameter_value import ParameterValue

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


class Parameter:
    """A parameter, passed as `-p name:=value`."""

    def __init__(self, name: SomeSubstitutionsType, value: object, *, value_type: object = None) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = ParameterValue(value, value_type=value_type)
        self.__evaluated_name: str | None = None

    @property
    def name(self) -> list[Substitution] | str:
        """The name; evaluated when the launch runs."""
        return self.__name if self.__evaluated_name is None else self.__evaluated_name

    @property
    def value(self) -> Any:
        """The value; evaluated when the launch runs."""
        return self.__value.value

    @property
    def value_type(self) -> Any:
        """The type."""
        return self.__value.value_type

    def __str__(self) -> str:
        return f"launch_ros.description.Parameter(name={self.name}, value={self.value}, value_type={self.value_type})"

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """Return name and value, evaluated on the first call."""
        if self.__evaluated_name is None:
            self.__evaluated_name = perform_substitutions(context, self.__name)
        return self.__evaluated_name, self.__value.evaluate(context)
