"""A handler for events addressed to a process."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from launch.event_handler import BaseEventHandler
from launch.events.process import ProcessTargetedEvent

if TYPE_CHECKING:
    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnTargetedProcess(BaseEventHandler):
    """Calls back if an event's own predicate selects the action."""

    def __init__(self, kind: type[ProcessTargetedEvent], action: Action, callback: Callable[[Any, Any], Any]) -> None:
        self.kind_of_events = kind
        self._callback = callback
        super().__init__(matcher=lambda event: isinstance(event, kind) and event.process_matcher(action))

    def handle(self, event: object, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the callback's result."""
        super().handle(event, context)
        return self._callback(event, context)
