"""Declaring an argument of a launch file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import launch.logging
from launch.action import Action
from launch.argument_discovery import DeclaresArgument
from launch.frontend.expose import expose_action
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("arg")
class DeclareLaunchArgument(Action, DeclaresArgument):
    """Declares a launch argument: sets the configuration of that name to a default, unless it is already set."""

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: Iterable[str] | None = None,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        self.__name = name
        self.__logger = launch.logging.get_logger(__name__)
        self.__choices = None if choices is None else list(choices)
        if self.__choices is not None:
            self.__check_choices(default_value)
        self.__default = None if default_value is None else normalize_to_list_of_substitutions(default_value)
        self.__description = self.__described(description)
        self._conditionally_included = False

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[DeclareLaunchArgument], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.escape_characters(entity.get_attr("name"))
        default = entity.get_attr("default", optional=True)
        if default is not None:
            kwargs["default_value"] = parser.parse_substitution(default)
        description = entity.get_attr("description", optional=True)
        if description is not None:
            kwargs["description"] = parser.escape_characters(description)
        choices = entity.get_attr("choice", data_type=list, optional=True)
        if choices:
            kwargs["choices"] = [parser.escape_characters(each.get_attr("value")) for each in choices]
            for each in choices:
                each.assert_entity_completely_parsed()
        return cls, kwargs

    def __check_choices(self, default_value: object) -> None:
        problem = ""
        if not self.__choices:
            problem = "Provided choices arg is empty. Use None to ignore the choice list."
        elif isinstance(default_value, str) and default_value not in self.__choices:
            problem = f'Provided default_value "{default_value}" is not in provided choices "{self.__choices}".'
        if problem:
            self.__logger.error(problem)
            raise RuntimeError(problem)

    def __described(self, description: str | None) -> str:
        if self.__choices is None:
            return "no description given" if description is None else description
        if description is None:
            return f"One of: {self.__choices}"
        dot = "" if description.endswith(".") else "."
        return f"{description}{dot} Valid choices are: {self.__choices}"

    @property
    def name(self) -> str:
        """The argument's name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The default; None if the argument is required."""
        return self.__default

    @property
    def description(self) -> str:
        """The description, with the valid choices."""
        return self.__description

    @property
    def choices(self) -> list[str] | None:
        """The valid values; None if any value is valid."""
        return self.__choices

    def __check_inherited(self, context: LaunchContext) -> None:
        def default() -> str | None:
            try:
                return None if self.default_value is None else perform_substitutions(context, self.default_value)
            except Exception:  # a default that is not used may refer to missing things
                return None

        context.includes.check(self.name, context.launch_configurations[self.name], default)

    def execute(self, context: LaunchContext) -> None:
        """Set the default if needed; raises `RuntimeError` for a missing or invalid value."""
        context.declared_arguments.add(self.name)
        if self.name not in context.launch_configurations:
            if self.default_value is None:
                self.__logger.error(
                    f'Required launch argument "{self.name}" (description: "{self.description}") was not provided'
                )
                raise RuntimeError(f'Required launch argument "{self.name}" was not provided.')
            value = perform_substitutions(context, self.default_value)
            context.launch_configurations[self.name] = value
            context.includes.default_set(self.name, value)
        else:
            self.__check_inherited(context)
        value = context.launch_configurations[self.name]
        if self.__choices is not None and value not in self.__choices:
            message = (
                f'Argument "{self.name}" provided value "{value}" is not valid. Valid options are: {self.__choices}'
            )
            self.__logger.error(message)
            raise RuntimeError(message)
