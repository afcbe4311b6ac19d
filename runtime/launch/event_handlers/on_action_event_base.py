"""Base class of handlers for the events of one action, of several, or of all."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from launch.event_handler import BaseEventHandler
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.action import Action
    from launch.event import Event
    from launch.launch_context import LaunchContext
    from launch.some_entities_type import SomeEntitiesType


class OnActionEventBase(BaseEventHandler):
    """Visits entities, or what a callable returns, on an event of an action."""

    def __init__(
        self,
        *,
        action_matcher: Action | Callable[[Action], bool] | None,
        on_event: SomeEntitiesType | Callable[..., SomeEntitiesType | None],
        target_event_cls: type[Event],
        target_action_cls: type[Action],
        handle_once: bool = False,
        **kwargs: bool,
    ) -> None:
        if action_matcher is not None and not (
            isinstance(action_matcher, target_action_cls) or callable(action_matcher)
        ):
            raise TypeError(f"action_matcher must be an '{target_action_cls.__name__}' instance or a callable")
        self.__target_event_cls = target_event_cls
        self.__action_matcher = action_matcher
        self.kind_of_events = target_event_cls
        self.target_of_events = action_matcher if isinstance(action_matcher, target_action_cls) else None
        self.__entities: list[LaunchDescriptionEntity] | None = None
        self.__callback: Callable[..., SomeEntitiesType | None] | None = None
        if callable(on_event) and not isinstance(on_event, LaunchDescriptionEntity):
            self.__callback = on_event
        else:
            self.__entities = _checked_entities(on_event)
        super().__init__(matcher=self._matches, handle_once=handle_once, **kwargs)

    def _matches(self, event: Any) -> bool:
        kind: type = self.__target_event_cls
        if not isinstance(event, kind):
            return False
        wanted: Any = self.__action_matcher
        if wanted is None or event.action is wanted:
            return True
        return self.target_of_events is None and bool(wanted(event.action))

    def handle(self, event: Any, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities, or the callable's result."""
        super().handle(event, context)
        if self.__entities is not None:
            return self.__entities
        assert self.__callback is not None
        return self._call(self.__callback, event, context)

    def _call(
        self, callback: Callable[..., SomeEntitiesType | None], event: Any, context: LaunchContext
    ) -> SomeEntitiesType | None:
        return callback(event, context)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Return a description and the entities."""
        if self.__entities is not None:
            return super().describe()[0], list(self.__entities)
        return super().describe()

    @property
    def handler_description(self) -> str:
        """A description of the handler's effect."""
        return f"{self.__callback}" if self.__callback is not None else "<actions>"

    @property
    def matcher_description(self) -> str:
        """A description of the matching events."""
        name = self.__target_event_cls.__name__
        if self.__action_matcher is None:
            return f"event == {name}"
        return f"event == {name} and event.action == {self.__action_matcher!r}"


def _checked_entities(on_event: object) -> list[LaunchDescriptionEntity]:
    if isinstance(on_event, LaunchDescriptionEntity):
        return [on_event]
    if not isinstance(on_event, Iterable):
        raise TypeError(
            f"on_event with type '{type(on_event)}' not allowed: expected a launch entity, an iterable of them, "
            "or a callable"
        )
    entities: list[Any] = [*on_event]
    for each in entities:
        if not isinstance(each, LaunchDescriptionEntity):
            raise TypeError(
                "expected all items in 'on_event' iterable to be of type "
                f"'LaunchDescriptionEntity' but got '{type(each)}'"
            )
    return entities
