"""Clearing the launch configurations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from launch.action import Action
from launch.argument_discovery import ResetsConfigurations
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("reset")
class ResetLaunchConfigurations(Action, ResetsConfigurations):
    """Clears all launch configurations except those given, whose values are evaluated first."""

    def __init__(
        self,
        launch_configurations: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        self.__kept: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] = (
            {} if launch_configurations is None else launch_configurations
        )

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ResetLaunchConfigurations], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["launch_configurations"] = parse_kept(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Clear the configurations that are not kept."""
        kept = {
            perform_substitutions(context, normalize_to_list_of_substitutions(name)): perform_substitutions(
                context, normalize_to_list_of_substitutions(value)
            )
            for name, value in self.__kept.items()
        }
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)


def parse_kept(entity: Entity, parser: Parser) -> dict[SomeSubstitutionsType, SomeSubstitutionsType]:
    """Parse the names and values of `keep` elements."""
    kept: dict[SomeSubstitutionsType, SomeSubstitutionsType] = {}
    for each in entity.get_attr("keep", data_type=list, optional=True) or ():
        name = tuple(parser.parse_substitution(each.get_attr("name")))
        kept[name] = parser.parse_substitution(each.get_attr("value"))
        each.assert_entity_completely_parsed()
    return kept
