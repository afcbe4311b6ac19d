"""Base classes of actions on an environment variable or a launch configuration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.some_substitutions_type import SomeSubstitutionsType


class Named(Action):
    """An action on something that has a name, in Python and as an attribute."""

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Named], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        return cls, kwargs

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable or configuration."""
        return self.__name


class NamedValue(Named):
    """An action that also has a value."""

    def __init__(self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(name, **kwargs)
        self.__value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[NamedValue], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    @property
    def value(self) -> list[Substitution]:
        """The value to set."""
        return self.__value
