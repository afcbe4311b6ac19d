"""Base class of events addressed to processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch.event import Event


class ProcessTargetedEvent(Event):
    """An event for the processes whose actions a predicate selects."""

    name = "launch.events.process.ProcessTargetedEvent"

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.__process_matcher = process_matcher

    @property
    def process_matcher(self) -> Callable[[Any], bool]:
        """The predicate over actions."""
        return self.__process_matcher
