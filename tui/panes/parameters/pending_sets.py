"""Values that were sent to a node and not answered yet."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count

from bot_console.tui.console.model import Value
from bot_console.tui.panes.parameters.staging import Key

ANSWER_DELAY_S = 0.5
"""Seconds after which a pending value is shown as such; most nodes answer within a few hundredths of a second."""


class PendingSets:
    """Tracks sent values by numbers; times are those of a monotonic clock (s)."""

    def __init__(self) -> None:
        self._numbers = count()
        self._sent: dict[int, tuple[float, Mapping[Key, Value]]] = {}

    def sent(self, values: Mapping[Key, Value], now: float) -> int:
        """Note values that were sent together; returns their number."""
        number = next(self._numbers)
        self._sent[number] = now, values
        return number

    def answered(self, number: int) -> None:
        """Note that the answer has arrived."""
        self._sent.pop(number, None)

    def late(self, now: float) -> Mapping[Key, Value]:
        """The values that have been pending for unusually long; of values sent twice, the newer one."""
        return {
            key: value
            for at, values in self._sent.values()
            if now - at >= ANSWER_DELAY_S
            for key, value in values.items()
        }
