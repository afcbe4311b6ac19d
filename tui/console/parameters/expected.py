"""The announcements that must come of sets made here, so that each change is told whose it was."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from bot_console.tui.console.model import ChangeSource, Value

EACH = 20
"""How many announcements of one parameter may be outstanding; a node that never announces leaves so many behind."""


@dataclass(frozen=True, slots=True)
class Wish:
    """A value that somebody asked for: who, and what it was a part of."""

    node: str
    name: str
    value: Value
    source: ChangeSource
    by: str = ""


class Expected:
    """What was asked for and not announced yet."""

    def __init__(self) -> None:
        self._wishes: dict[tuple[str, str], deque[Wish]] = {}

    def add(self, wish: Wish) -> None:
        """Something was asked for."""
        self._wishes.setdefault((wish.node, wish.name), deque(maxlen=EACH)).append(wish)

    def announced(self, node: str, name: str, value: Value) -> Wish | None:
        """The wish that an announcement answers; None where nobody here has asked for it."""
        found = next((each for each in self._wishes.get((node, name), ()) if each.value == value), None)
        if found:
            self.forget(found)
        return found

    def forget(self, wish: Wish) -> None:
        """A wish was refused, or answered."""
        wishes = self._wishes.get((wish.node, wish.name))
        if wishes and wish in wishes:
            wishes.remove(wish)
            if not wishes:
                del self._wishes[wish.node, wish.name]
