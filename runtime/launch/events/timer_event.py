"""A timer has expired."""

from __future__ import annotations

from typing import Any

from launch.event import Event


class TimerEvent(Event):
    """A timer action has expired."""

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: object) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> Any:
        """The timer action."""
        return self.__timer_action
