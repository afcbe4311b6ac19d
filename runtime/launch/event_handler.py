"""Event handlers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.some_entities_type import SomeEntitiesType, check_entities

if TYPE_CHECKING:
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity


class BaseEventHandler:
    """Decides whether it handles an event, and which entities are visited for it."""

    kind_of_events: type[Event] | None = None
    """The class of all matching events; None if any class may match."""
    target_of_events: object = None
    """The only action whose events match; None if any action may match."""

    def __init__(self, *, matcher: Callable[[Event], bool], handle_once: bool = False) -> None:
        self.__matcher = matcher
        self.__handle_once = handle_once

    @property
    def handle_once(self) -> bool:
        """Whether the handler is removed after its first event."""
        return self.__handle_once

    @property
    def handler_description(self) -> str:
        """A description of the handler's effect."""
        return "{}"

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        return "{}"

    def matches(self, event: Event) -> bool:
        """Whether the handler handles the event."""
        return self.__matcher(event)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities below."""
        what = f"matcher='{self.matcher_description}', handler='{self.handler_description}'"
        return f"{type(self).__name__}({what}, handle_once={self.handle_once})", []

    def handle(self, event: object, context: LaunchContext) -> SomeEntitiesType | None:
        """Handle the event and return entities to visit."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """Visits given entities for each matching event."""

    def __init__(
        self, *, matcher: Callable[[Event], bool], entities: SomeEntitiesType | None = None, handle_once: bool = False
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.__entities = entities

    @property
    def entities(self) -> SomeEntitiesType | None:
        """The entities to visit."""
        return self.__entities

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities."""
        return super().describe()[0], check_entities(self.__entities)

    def handle(self, event: object, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities to visit."""
        super().handle(event, context)
        return self.__entities
