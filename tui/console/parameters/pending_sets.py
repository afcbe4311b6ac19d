"""Values that were sent to a node and are not answered yet, or not seen in its parameters yet."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count

from bot_console.tui.console.model import Value, same
from bot_console.tui.console.parameters.staging import Key

EVENT_TIMEOUT_S = 1.0
"""Seconds that an accepted value counts as the current one although the node has not announced it."""
ANSWER_DELAY_S = 0.5
"""Seconds after which an unanswered value is shown as such; most nodes answer within a few hundredths of a second."""


class PendingSets:
    """Tracks sent values, which are numbered; times are those of a monotonic clock (s)."""

    def __init__(self) -> None:
        self._numbers = count()
        self._sent: dict[int, tuple[float, Mapping[Key, Value]]] = {}
        self._newest: dict[Key, Value] = {}
        self._accepted: dict[Key, tuple[float, Value]] = {}

    def sent(self, values: Mapping[Key, Value], now: float) -> int:
        """Add values that were sent together; returns their number."""
        number = next(self._numbers)
        self._sent[number] = now, values
        return number

    def answered(self, number: int, accepted: Mapping[Key, Value], now: float) -> None:
        """Record that values were answered, and which of them were accepted."""
        self._sent.pop(number, None)
        self._accepted.update({key: (now, value) for key, value in accepted.items()})

    def keep(self, key: Key, value: Value) -> bool:
        """Keep a value for later if an earlier value of the parameter is unanswered; returns whether it is."""
        waits = any(key in values for _, values in self._sent.values())
        if waits:
            self._newest[key] = value
        return waits

    def take(self, key: Key) -> Value:
        """Remove and return the newest value kept since the last one was sent; None if there is none."""
        return self._newest.pop(key, None)

    def value(self, key: Key, present: Value, now: float) -> Value:
        """The value that a parameter will have: the newest kept, sent or accepted one, else the present one."""
        if key in self._newest:
            return self._newest[key]
        for _, values in reversed(self._sent.values()):
            if key in values:
                return values[key]
        at, value = self._accepted.get(key, (now, present))
        if now - at >= EVENT_TIMEOUT_S or same(value, present):
            self._accepted.pop(key, None)
            return present
        return value

    def late(self, now: float) -> Mapping[Key, Value]:
        """The values that have been unanswered for unusually long, or a newer value that is kept for later."""
        return {
            key: self._newest.get(key, value)
            for at, values in self._sent.values()
            if now - at >= ANSWER_DELAY_S
            for key, value in values.items()
        }
