"""Unsetting an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("unset_env")
class UnsetEnvironmentVariable(Action):
    """Unsets an environment variable for processes visited later."""

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[UnsetEnvironmentVariable], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """The variable's name."""
        return self.__name

    def execute(self, context: LaunchContext) -> None:
        """Unset the variable, if it is set."""
        context.environment.pop(perform_substitutions(context, self.__name), None)
