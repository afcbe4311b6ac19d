"""The parameter events expected after sets made here, so that each change is attributed to its source."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from bot_console.tui.console.model import ChangeSource, Value

EACH = 20
"""How many announcements of one parameter may be outstanding; a node that never announces leaves so many behind."""


@dataclass(frozen=True, slots=True)
class Wish:
    """A requested value: its source, and the operation it was part of."""

    node: str
    name: str
    value: Value
    source: ChangeSource
    by: str = ""


class Expected:
    """The requests that have not been announced yet."""

    def __init__(self) -> None:
        self._wishes: dict[tuple[str, str], deque[Wish]] = {}

    def add(self, wish: Wish) -> None:
        """Add a request."""
        self._wishes.setdefault((wish.node, wish.name), deque(maxlen=EACH)).append(wish)

    def announced(self, node: str, name: str, value: Value) -> Wish | None:
        """The request that an event answers; None if nobody here made one."""
        found = next((each for each in self._wishes.get((node, name), ()) if each.value == value), None)
        if found:
            self.forget(found)
        return found

    def forget(self, wish: Wish) -> None:
        """Remove a request that was refused or answered."""
        wishes = self._wishes.get((wish.node, wish.name))
        if wishes and wish in wishes:
            wishes.remove(wish)
            if not wishes:
                del self._wishes[wish.node, wish.name]
