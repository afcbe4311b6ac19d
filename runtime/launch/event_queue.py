"""The queue of events of a launch."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any


class EventQueue:
    """Events that wait to be handled; says so when there is one."""

    def __init__(self) -> None:
        self._events: deque[Any] = deque()
        self.on_event: Callable[[], None] = lambda: None

    def put_nowait(self, event: Any) -> None:
        """Add an event."""
        self._events.append(event)
        self.on_event()

    def get_nowait(self) -> Any:
        """Take the oldest event out; raises `IndexError` when there is none."""
        return self._events.popleft()

    def empty(self) -> bool:
        """Whether nothing waits."""
        return not self._events

    def qsize(self) -> int:
        """How many wait."""
        return len(self._events)
