"""Appending to an environment variable."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_action
from launch.named_value import NamedValue
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("append_env")
class AppendEnvironmentVariable(NamedValue):
    """Appends to an environment variable, or prepends to it."""

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: object = False,
        separator: SomeSubstitutionsType = os.pathsep,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(name, value, **kwargs)
        self.__prepend = normalize_typed_substitution(prepend, bool)
        self.__separator = normalize_to_list_of_substitutions(separator)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[AppendEnvironmentVariable], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        prepend = entity.get_attr("prepend", optional=True, data_type=bool, can_be_str=True)
        if prepend is not None:
            kwargs["prepend"] = parser.parse_if_substitutions(prepend)
        separator = entity.get_attr("separator", optional=True)
        if separator is not None:
            kwargs["separator"] = parser.parse_substitution(separator)
        return cls, kwargs

    @property
    def prepend(self) -> Any:
        """Whether the value is prepended."""
        return self.__prepend

    @property
    def separator(self) -> list[Substitution]:
        """The separator between old and new value."""
        return self.__separator

    def execute(self, context: LaunchContext) -> None:
        """Append or prepend the value."""
        name = perform_substitutions(context, self.name)
        value = perform_substitutions(context, self.value)
        before = perform_typed_substitution(context, self.__prepend, bool)
        separator = perform_substitutions(context, self.__separator)
        if name in context.environment:
            old = context.environment[name]
            value = f"{value}{separator}{old}" if before else f"{old}{separator}{value}"
        context.environment[name] = value
