"""Handler for state transitions of a lifecycle node."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.event_handler import EventHandler
from launch_ros.events.lifecycle import StateTransition

if TYPE_CHECKING:
    from launch.some_entities_type import SomeEntitiesType


class OnStateTransition(EventHandler):
    """Visits entities on a transition of a lifecycle node; names that are not given match any name."""

    kind_of_events = StateTransition

    def __init__(
        self,
        *,
        entities: SomeEntitiesType,
        target_lifecycle_node: Any = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        matcher: Callable[[Any], bool] | None = None,
        **kwargs: bool,
    ) -> None:
        if not ((matcher is None) ^ (target_lifecycle_node is None)):
            raise RuntimeError("either matcher or target_lifecycle_node must be set")
        self.__wanted = {"transition": transition, "start_state": start_state, "goal_state": goal_state}
        self.__matcher_of_action = matcher
        self.__target = target_lifecycle_node
        super().__init__(matcher=self._matches, entities=entities, **kwargs)

    def _matches(self, event: object) -> bool:
        if not isinstance(event, StateTransition):
            return False
        if self.__target is not None and event.action is not self.__target:
            return False
        if self.__matcher_of_action is not None and not self.__matcher_of_action(event):
            return False
        return all(wanted is None or getattr(event, name) == wanted for name, wanted in self.__wanted.items())
