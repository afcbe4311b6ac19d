"""A group of actions with its own scope."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from launch.action import Action
from launch.actions.pop_environment import PopEnvironment
from launch.actions.pop_launch_configurations import PopLaunchConfigurations
from launch.actions.push_environment import PushEnvironment
from launch.actions.push_launch_configurations import PushLaunchConfigurations
from launch.actions.reset_environment import ResetEnvironment
from launch.actions.reset_launch_configurations import ResetLaunchConfigurations, parse_kept
from launch.actions.set_launch_configuration import SetLaunchConfiguration
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("group")
class GroupAction(Action):
    """Groups actions under a condition and, by default, a scope for configurations and environment."""

    def __init__(
        self,
        actions: Iterable[Action],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        self.__actions = actions
        self.__scoped = scoped
        self.__forwarding = forwarding
        self.__configurations: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] = (
            {} if launch_configurations is None else launch_configurations
        )
        self.__to_return: list[LaunchDescriptionEntity] | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[GroupAction], dict[str, object]]:
        """Parse the element in XML or YAML."""
        _, kwargs = super().parse(entity, parser)
        for name in ("scoped", "forwarding"):
            value = entity.get_attr(name, data_type=bool, optional=True)
            if value is not None:
                kwargs[name] = value
        kept = parse_kept(entity, parser)
        if kept:
            kwargs["launch_configurations"] = kept
        kwargs["actions"] = [parser.parse_action(each) for each in entity.children if each.type_name != "keep"]
        return cls, kwargs

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions, enclosed by those that create and end the scope."""
        if self.__to_return is None:
            self.__to_return = self._with_scope(list(self.__actions))
        return self.__to_return

    def _with_scope(self, actions: list[Action]) -> list[LaunchDescriptionEntity]:
        values = [SetLaunchConfiguration(name, value) for name, value in self.__configurations.items()]
        if not self.__scoped:
            return [*values, *actions]
        begin: list[Action] = [PushLaunchConfigurations(), PushEnvironment()]
        end = [PopEnvironment(), PopLaunchConfigurations()]
        if self.__forwarding:
            return [*begin, *values, *actions, *end]
        begin += [ResetEnvironment(), ResetLaunchConfigurations(self.__configurations)]
        return [*begin, *actions, *end]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions to visit."""
        return self.get_sub_entities()
