"""Emitting events."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from launch.event import Event

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.launch_context import LaunchContext


class EmitEvent(Action):
    """Emits an event."""

    def __init__(self, *, event: Event, **kwargs: Condition | None) -> None:
        super().__init__(**kwargs)
        if not isinstance(event, Event):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise RuntimeError(f"EmitEvent() expected an event instance, got '{event}'.")
        self.__event = event

    @property
    def event(self) -> Event:
        """The event to emit."""
        return self.__event

    def execute(self, context: LaunchContext) -> None:
        """Emit the event."""
        context.emit_event_sync(self.__event)
