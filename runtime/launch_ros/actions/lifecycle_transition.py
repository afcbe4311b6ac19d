"""Drive lifecycle nodes through transitions."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import TYPE_CHECKING

from launch.action import Action
from launch.actions import EmitEvent, RegisterEventHandler
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

GOALS = {1: "inactive", 2: "unconfigured", 3: "active", 4: "inactive", 5: "finalized", 6: "finalized", 7: "finalized"}
"""The final state of each public transition, by its number in `lifecycle_msgs/msg/Transition`."""


class LifecycleTransition(Action):
    """Drives each of several lifecycle nodes through a sequence of transitions; raises `ValueError` without nodes."""

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[SomeSubstitutionsType],
        transition_ids: Iterable[int | SomeSubstitutionsType],
        **kwargs: Condition | None,
    ) -> None:
        super().__init__(**kwargs)
        self.__names = [normalize_to_list_of_substitutions(each) for each in lifecycle_node_names]
        self.__transitions = list(transition_ids)
        if not self.__names:
            raise ValueError("lifecycle_node_names must provide at least one lifecycle node name")
        if not self.__transitions:
            raise ValueError("transition_ids must provide at least one lifecycle node transition id")

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Request the first transition of each node, and each further one when the previous one has finished."""
        numbers = [_number(context, each) for each in self.__transitions]
        entities: list[LaunchDescriptionEntity] = []
        for subs in self.__names:
            name = perform_substitutions(context, subs)
            entities += self._of_node(name, numbers)
        return entities

    def _of_node(self, name: str, numbers: list[int]) -> list[LaunchDescriptionEntity]:
        matcher = matches_node_name(name)

        def change(number: int) -> EmitEvent:
            return EmitEvent(event=ChangeState(lifecycle_node_matcher=matcher, transition_id=number))

        handlers = [
            RegisterEventHandler(
                OnStateTransition(
                    matcher=lambda event: matcher(event.action),
                    goal_state=GOALS.get(before),
                    entities=[change(number)],
                    handle_once=True,
                )
            )
            for before, number in pairwise(numbers)
        ]
        return [*handlers, change(numbers[0])]


def _number(context: LaunchContext, transition: int | SomeSubstitutionsType) -> int:
    if isinstance(transition, int):
        return transition
    return int(perform_substitutions(context, normalize_to_list_of_substitutions(transition)))
