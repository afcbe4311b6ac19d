"""Values that are staged instead of sent, and the two sets that are compared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from bot_console.tui.console.model import ParameterTree, Value, parameter_in

Key: TypeAlias = "tuple[str, str]"
Values: TypeAlias = "dict[Key, Value]"
SETS = ("set A", "set B")
"""The names of the two sets in the journal."""


@dataclass
class Staging:
    """The marked values, and the sets A and B with the one that is live."""

    marking: bool = False
    """Whether edits are marked instead of sent."""
    marked: Values = field(default_factory=dict[Key, Value])
    sets: tuple[Values, Values] | None = None
    live: int = 0
    """Which of the sets was sent last."""

    def mark(self, key: Key, now: Value, value: Value) -> None:
        """Mark a value; the present value needs no mark."""
        if value == now and type(value) is type(now):
            self.marked.pop(key, None)
        else:
            self.marked[key] = value

    def begin(self, values: Values, trees: Mapping[str, ParameterTree]) -> None:
        """Create the two sets: A with the present values of the marked parameters, B with the marked ones; A is
        live.
        """
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
        """The state of staging in a few words."""
        parts: list[str] = []
        if self.marking or self.marked:
            parts.append(f"{'marking, ' if self.marking else ''}{len(self.marked)} marked: a applies")
        if self.sets:
            parts.append(f"A sends {SETS[1 - self.live]}")
        return "  ".join(parts)


def by_node(values: Mapping[Key, Value]) -> dict[str, dict[str, Value]]:
    """Values by node and name."""
    found: dict[str, dict[str, Value]] = {}
    for (node, name), value in values.items():
        found.setdefault(node, {})[name] = value
    return found
