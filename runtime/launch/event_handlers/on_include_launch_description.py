"""Handler for requests to include a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handler import BaseEventHandler
from launch.events.include_launch_description import IncludeLaunchDescription
from launch.utilities import is_a_subclass

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnIncludeLaunchDescription(BaseEventHandler):
    """Visits a launch description whose inclusion is requested."""

    kind_of_events = IncludeLaunchDescription

    def __init__(self, **kwargs: bool) -> None:
        super().__init__(matcher=lambda event: is_a_subclass(event, IncludeLaunchDescription), **kwargs)

    def handle(self, event: Any, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the description to visit."""
        super().handle(event, context)
        return event.launch_description

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        return "event issubclass of launch.events.IncludeLaunchDescription"
