"""Values that were sent to a node: not answered yet, or not seen in its parameters yet."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count

from bot_console.tui.console.model import Value, same
from bot_console.tui.console.parameters.staging import Key

EVENT_TIMEOUT_S = 1.0
"""Seconds for which an accepted value is taken for the present one although the node has not announced it."""
ANSWER_DELAY_S = 0.5
"""Seconds after which a pending value is shown as such; most nodes answer within a few hundredths of a second."""


class PendingSets:
    """Tracks sent values by numbers; times are those of a monotonic clock (s)."""

    def __init__(self) -> None:
        self._numbers = count()
        self._sent: dict[int, tuple[float, Mapping[Key, Value]]] = {}
        self._newest: dict[Key, Value] = {}
        self._accepted: dict[Key, tuple[float, Value]] = {}

    def sent(self, values: Mapping[Key, Value], now: float) -> int:
        """Note values that were sent together; returns their number."""
        number = next(self._numbers)
        self._sent[number] = now, values
        return number

    def answered(self, number: int, accepted: Mapping[Key, Value], now: float) -> None:
        """Note that the answer has arrived, with the values that were accepted."""
        self._sent.pop(number, None)
        self._accepted.update({key: (now, value) for key, value in accepted.items()})

    def keep(self, key: Key, value: Value) -> bool:
        """Keep a value for later if an earlier one of the parameter is not answered yet; returns whether it is so."""
        waits = any(key in values for _, values in self._sent.values())
        if waits:
            self._newest[key] = value
        return waits

    def take(self, key: Key) -> Value:
        """The newest value that was kept since the last one was sent, which is no longer kept; None without one."""
        return self._newest.pop(key, None)

    def value(self, key: Key, present: Value, now: float) -> Value:
        """The value that a parameter will have: the newest kept, sent or accepted one, or else the present one."""
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
        """The values that have been pending for unusually long; of values sent twice, the newer one."""
        return {
            key: self._newest.get(key, value)
            for at, values in self._sent.values()
            if now - at >= ANSWER_DELAY_S
            for key, value in values.items()
        }
