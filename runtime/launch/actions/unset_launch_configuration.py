"""Unsetting a launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


class UnsetLaunchConfiguration(Action):
    """Unsets a launch configuration, if it is set."""

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """The configuration's name."""
        return self.__name

    def execute(self, context: LaunchContext) -> None:
        """Unset the configuration, if it is set."""
        context.launch_configurations.pop(perform_substitutions(context, self.__name), None)
