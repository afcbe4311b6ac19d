"""Remap rules for all subsequent nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.frontend import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("set_remap")
class SetRemap(Action):
    """Passes a remap rule to all subsequent nodes."""

    def __init__(self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        self.__source = normalize_to_list_of_substitutions(src)
        self.__target = normalize_to_list_of_substitutions(dst)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetRemap], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        kwargs["src"] = parser.parse_substitution(entity.get_attr("from"))
        kwargs["dst"] = parser.parse_substitution(entity.get_attr("to"))
        return cls, kwargs

    @property
    def src(self) -> list[Substitution]:
        """The name that the node uses."""
        return self.__source

    @property
    def dst(self) -> list[Substitution]:
        """The name that replaces it."""
        return self.__target

    def execute(self, context: LaunchContext) -> None:
        """Add the rule."""
        rule = (perform_substitutions(context, self.__source), perform_substitutions(context, self.__target))
        context.launch_configurations.setdefault("ros_remaps", [])
        context.launch_configurations["ros_remaps"].append(rule)
