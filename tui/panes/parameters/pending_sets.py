"""Values that were sent to a node and that it has not answered yet."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count

from bot_console.tui.console.model import Value
from bot_console.tui.panes.parameters.staging import Key

ANSWER_DELAY_S = 0.5
"""Seconds that a node takes before it is said that it is waited for: most answer within a few hundredths."""


class PendingSets:
    """What was sent, each time with its number; times are those of a steady clock (s)."""

    def __init__(self) -> None:
        self._numbers = count()
        self._sent: dict[int, tuple[float, Mapping[Key, Value]]] = {}

    def sent(self, values: Mapping[Key, Value], now: float) -> int:
        """Values were sent together; the number by which they are answered."""
        number = next(self._numbers)
        self._sent[number] = now, values
        return number

    def answered(self, number: int) -> None:
        """The answer is there, whatever it is."""
        self._sent.pop(number, None)

    def late(self, now: float) -> Mapping[Key, Value]:
        """What has been waited for longer than is usual; of values sent twice the newer one."""
        return {
            key: value
            for at, values in self._sent.values()
            if now - at >= ANSWER_DELAY_S
            for key, value in values.items()
        }
