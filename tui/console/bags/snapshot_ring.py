"""A ring buffer of the last minutes of messages, limited in time and memory."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import Any

from bot_console.tui.console.bags.recorder import Sink

MESSAGE_OVERHEAD_BYTES = 200
"""Memory (bytes) that a kept message needs beyond its data."""


class Ring:
    """Keeps the last minutes in memory, so that they can be saved after an event."""

    def __init__(self, seconds: float, maximum: int) -> None:
        """Keeps messages of at most `seconds`, in at most `maximum` bytes."""
        self._seconds = seconds
        self._maximum = maximum
        self._held = 0
        self._kept: deque[tuple[int, str, bytes]] = deque()
        self.topics: dict[str, tuple[Any, list[dict[str, Any]], str]] = {}

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic."""
        self.topics[name] = kind, qos, type_hash

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message, and discard those that are too old or exceed the limit."""
        self._kept.append((received, topic, data))
        self._held += len(data) + MESSAGE_OVERHEAD_BYTES
        oldest = received - int(self._seconds * 1e9)
        while self._kept and (self._kept[0][0] < oldest or self._held > self._maximum):
            self._held -= len(self._kept.popleft()[2]) + MESSAGE_OVERHEAD_BYTES

    @property
    def begin(self) -> int:
        """The time (ns since the epoch) of the oldest message kept; 0 if there is none."""
        return self._kept[0][0] if self._kept else 0

    @property
    def span(self) -> float:
        """Seconds between the oldest and the newest message kept."""
        return (self._kept[-1][0] - self._kept[0][0]) / 1e9 if self._kept else 0.0

    def flush(self) -> None:
        """Do nothing: nothing is written before `pour`."""

    def pour(self, sink: Sink) -> int:
        """Write all kept messages to a sink; returns their number."""
        kept: Iterable[tuple[int, str, bytes]] = list(self._kept)
        for name, (kind, qos, type_hash) in self.topics.items():
            sink.topic(name, kind, qos, type_hash)
        count = 0
        for received, topic, data in kept:
            sink.write(topic, data, received, 0)
            count += 1
        return count
