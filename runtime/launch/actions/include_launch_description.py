"""Including a launch file."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.action import Action
from launch.actions.set_launch_configuration import SetLaunchConfiguration
from launch.argument_discovery import IncludesDescription
from launch.frontend.expose import expose_action
from launch.inherited_arguments import Include
from launch.launch_context import LaunchContext
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_description import LaunchDescription
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

Pair = tuple[Any, Any]


@expose_action("include")
class IncludeLaunchDescription(Action, IncludesDescription):
    """Includes another launch file, in the same scope: its configurations remain visible afterwards."""

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType,
        *,
        launch_arguments: Iterable[Pair] | None = None,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self.__source = launch_description_source
        self.__arguments = () if launch_arguments is None else tuple(launch_arguments)
        self.__logger = launch.logging.get_logger(__name__)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[IncludeLaunchDescription], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["launch_description_source"] = parser.parse_substitution(entity.get_attr("file"))
        arguments: list[Pair] = []
        given = [entity.get_attr(tag, data_type=list, optional=True) or () for tag in ("arg", "let")]
        for each in (*given[0], *given[1]):
            name, value = each.get_attr("name"), each.get_attr("value")
            arguments.append((parser.parse_substitution(name), parser.parse_substitution(value)))
            each.assert_entity_completely_parsed()
        if arguments:
            kwargs["launch_arguments"] = arguments
        return cls, kwargs

    @property
    def launch_description_source(self) -> LaunchDescriptionSource:
        """The source of the launch file."""
        return self.__source

    @property
    def launch_arguments(self) -> tuple[Pair, ...]:
        """Names and values of the arguments."""
        return self.__arguments

    def describe(self) -> str:
        """Return a short description."""
        return f"IncludeLaunchDescription({self.__source.location})"

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the description if it can be read without a context."""
        try:
            description = self.__source.try_get_launch_description_without_context()
        except Exception:  # an unreadable file declares nothing; it fails when visited
            return []
        return [] if description is None else [description]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Read the file, check its required arguments, and return its entities to visit."""
        description = self.__source.get_launch_description(context)
        self._set_locals(context)
        given = self._given_names(context)
        include = Include(self.__source.location, self.origin, frozenset(given))
        self._check_required(description, given)
        return [
            *(SetLaunchConfiguration(name, value) for name, value in self.__arguments),
            _EnterInclude(include),
            description,
            _LeaveInclude(),
        ]

    def _check_required(self, description: LaunchDescription, given: list[str]) -> None:
        """Raise `RuntimeError` for a required argument that is not given; nested includes add to the given names."""
        for argument, below in description.get_launch_arguments_with_include_launch_description_actions():
            if argument._conditionally_included or argument.default_value is not None:
                continue
            for include in below or ():
                given += include._given_names_without_context()
            if argument.name not in given:
                raise RuntimeError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(given)}]"
                )

    def _given_names(self, context: LaunchContext) -> list[str]:
        return [
            perform_substitutions(context, normalize_to_list_of_substitutions(name)) for name, _ in self.__arguments
        ]

    def _given_names_without_context(self) -> list[str]:
        try:
            return self._given_names(LaunchContext())
        except Exception:  # a name that is known only in the running launch cannot be counted
            return []

    def _set_locals(self, context: LaunchContext) -> None:
        path = os.path.abspath(self.__source.location)
        context.extend_locals({"current_launch_file_path": path})
        folder = os.path.dirname(path) if os.path.exists(path) else self.__source.location
        context.extend_locals({"current_launch_file_directory": folder})


class IncludeBoundary(Action):
    """Base of the actions visited before and after an include's description; they are not part of the launch file."""


class _EnterInclude(IncludeBoundary):
    """Visited after an include has set its arguments, before its description."""

    def __init__(self, include: Include) -> None:
        super().__init__()
        self._include = include

    def execute(self, context: LaunchContext) -> None:
        """Begin the include."""
        context.includes.enter(self._include, context.launch_configurations)


class _LeaveInclude(IncludeBoundary):
    """Visited after the description of an include."""

    def execute(self, context: LaunchContext) -> None:
        """End the include."""
        context.includes.leave()
