"""The most recent events of launches."""

from __future__ import annotations

import time
from collections import deque

from bot_console.tui.console.model import LaunchEvent, Severity

MAX_EVENTS = 500


class LaunchTimeline:
    """Keeps launch events, numbered from 0; the oldest are dropped."""

    def __init__(self) -> None:
        self._events: deque[LaunchEvent] = deque(maxlen=MAX_EVENTS)
        self._count = 0

    def report(self, text: str, severity: Severity = Severity.INFO) -> None:
        """Add an event with the current time."""
        self._events.append(LaunchEvent(self._count, time.time_ns(), text, severity))
        self._count += 1

    @property
    def events(self) -> tuple[LaunchEvent, ...]:
        """The kept events, oldest first."""
        return tuple(self._events)
