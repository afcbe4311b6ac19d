"""Clearing the launch configurations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.argument_discovery import ResetsConfigurations
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


@expose_action("reset")
class ResetLaunchConfigurations(Action, ResetsConfigurations):
    """Clears all launch configurations except those given, whose values are evaluated first."""

    def __init__(self, launch_configurations: Mapping[Any, Any] | None = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__kept: Mapping[Any, Any] = {} if launch_configurations is None else launch_configurations

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[ResetLaunchConfigurations], dict[str, Any]]:
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


def parse_kept(entity: Entity, parser: Parser) -> dict[Any, Any]:
    """Parse the names and values of `keep` elements."""
    kept: dict[Any, Any] = {}
    for each in entity.get_attr("keep", data_type=list, optional=True) or ():
        name = tuple(parser.parse_substitution(each.get_attr("name")))
        kept[name] = parser.parse_substitution(each.get_attr("value"))
        each.assert_entity_completely_parsed()
    return kept
