"""A deprecated condition on the value of one launch configuration."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from launch.condition import Condition
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class LaunchConfigurationEquals(Condition):
    """True if a launch configuration has a given value; None stands for an unset one."""

    def __init__(self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None) -> None:
        name = type(self).__name__
        substitution = name.replace("LaunchConfiguration", "") + "Substitution"
        warnings.warn(
            f"The '{name}' condition is deprecated. Use the '{substitution}' in combination with 'LaunchConfiguration' "
            "and 'IfCondition' instead.",
            UserWarning,
            stacklevel=2,
        )
        self.__name = launch_configuration_name
        self.__expected = None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        super().__init__(predicate=self._predicate_func)

    def _predicate_func(self, context: LaunchContext) -> bool:
        expected = None if self.__expected is None else perform_substitutions(context, self.__expected)
        return context.launch_configurations.get(self.__name) == expected
