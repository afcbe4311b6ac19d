"""An action has completed."""

from __future__ import annotations

from typing import Any

from launch.event import Event


class ExecutionComplete(Event):
    """An action is done; an asynchronous one is done when its future is."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: object) -> None:
        self.__action = action

    @property
    def action(self) -> Any:
        """The action."""
        return self.__action
