"""The queue of events of a launch."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any


class EventQueue:
    """Events to be handled; `on_event` is called for each new one."""

    def __init__(self) -> None:
        self._events: deque[Any] = deque()
        self.on_event: Callable[[], None] = lambda: None

    def put_nowait(self, event: object) -> None:
        """Add an event."""
        self._events.append(event)
        self.on_event()

    def get_nowait(self) -> Any:
        """Remove and return the oldest event; raises `IndexError` if there is none."""
        return self._events.popleft()

    def empty(self) -> bool:
        """Whether the queue is empty."""
        return not self._events

    def qsize(self) -> int:
        """Return the number of queued events."""
        return len(self._events)
