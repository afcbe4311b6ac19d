"""Values that are marked instead of sent, and two sets of values for comparison."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from bot_console.tui.console.model import ParameterTree, Value, parameter_in

Key: TypeAlias = "tuple[str, str]"
Values: TypeAlias = "dict[Key, Value]"
SETS = ("set A", "set B")
"""The names of the two sets, as in the journal."""


@dataclass
class Staging:
    """The marked values, and the sets A and B, one of which is live."""

    marking: bool = False
    """Whether edits are marked instead of sent."""
    marked: Values = field(default_factory=dict[Key, Value])
    sets: tuple[Values, Values] | None = None
    live: int = 0
    """The index of the set that was sent last."""

    def mark(self, key: Key, now: Value, value: Value) -> None:
        """Mark a value; marking the present value removes the mark."""
        if value == now and type(value) is type(now):
            self.marked.pop(key, None)
        else:
            self.marked[key] = value

    def begin(self, values: Values, trees: Mapping[str, ParameterTree]) -> None:
        """Create the two sets, A from the present values of the parameters and B from the given ones; A is live."""
        before: Values = {}
        for key in values:
            if (parameter := parameter_in(trees, *key)) is not None:
                before[key] = parameter.value
        self.sets = (before, {key: values[key] for key in before})
        self.live = 0
        self.marked = {}
        self.marking = False

    @property
    def other(self) -> Values:
        """The values of the set that is not live."""
        return self.sets[1 - self.live] if self.sets else {}

    def caption(self) -> str:
        """The state of staging, in a few words for users."""
        parts: list[str] = []
        if self.marking or self.marked:
            parts.append(f"{'marking, ' if self.marking else ''}{len(self.marked)} marked: a applies")
        if self.sets:
            parts.append(f"A sends {SETS[1 - self.live]}")
        return "  ".join(parts)


def by_node(values: Mapping[Key, Value]) -> dict[str, dict[str, Value]]:
    """Convert values by key to values by node and name."""
    found: dict[str, dict[str, Value]] = {}
    for (node, name), value in values.items():
        found.setdefault(node, {})[name] = value
    return found
