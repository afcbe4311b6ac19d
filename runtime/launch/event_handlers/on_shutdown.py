"""Handler for the shutdown of the launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.event_handler import BaseEventHandler
from launch.events.shutdown import Shutdown
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.utilities import is_a_subclass

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnShutdown(BaseEventHandler):
    """Handles the shutdown of the launch: entities, or a callable `(event, context)` that may return some."""

    kind_of_events = Shutdown

    def __init__(
        self, *, on_shutdown: SomeEntitiesType | Callable[..., SomeEntitiesType | None], **kwargs: bool
    ) -> None:
        super().__init__(matcher=lambda event: is_a_subclass(event, Shutdown), **kwargs)
        self.__on_shutdown = on_shutdown

    def handle(self, event: object, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities to visit."""
        super().handle(event, context)
        if callable(self.__on_shutdown) and not isinstance(self.__on_shutdown, LaunchDescriptionEntity):
            return self.__on_shutdown(event, context)
        return self.__on_shutdown

    @property
    def handler_description(self) -> str:
        """A description of the handler's effect."""
        return f"{self.__on_shutdown}"

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        return "event issubclass of launch.events.Shutdown"
