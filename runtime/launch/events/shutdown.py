"""The launch is shutting down."""

from __future__ import annotations

from launch.event import Event


class Shutdown(Event):
    """The launch ends, with all its processes."""

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not set", due_to_sigint: bool = False) -> None:
        self.__reason = reason
        self.__due_to_sigint = due_to_sigint

    @property
    def reason(self) -> str:
        """The reason for the shutdown."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Whether the user pressed Ctrl-C."""
        return self.__due_to_sigint
