"""A tunable: one parameter of one node, and the range that a search may use."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TypeAlias

from bot_console.tui.console.model import Range

TunableValue: TypeAlias = "bool | int | float"
Setting: TypeAlias = "tuple[TunableValue, ...]"
"""A value for each tunable, in their order."""

MIN_VALUES = 500
"""The minimum number of different values of a continuous tunable; more digits would make no difference."""


@dataclass(frozen=True)
class Tunable:
    """A number or a boolean of a node, from `low` to `high`, both included; `kind` is bool, integer or double."""

    node: str
    name: str
    kind: str
    low: float
    high: float
    now: TunableValue
    """The value without tuning."""
    unit: str = ""
    allowed: Range | None = None
    """The range of the descriptor, whose step the values follow; None if there is none."""

    @property
    def label(self) -> str:
        """Node and name, as users type them."""
        return f"{self.node}:{self.name}"

    @property
    def levels(self) -> int:
        """The number of different values."""
        if self.kind == "double":
            return min(MIN_VALUES, self._points or MIN_VALUES) if self.high > self.low else 1
        return self._points or int(math.floor(self.high) - math.ceil(self.low)) + 1

    def at(self, share: float) -> TunableValue:
        """The value at a fraction of the range, limited to 0 to 1."""
        value = self.low + share * (self.high - self.low)
        if self.kind == "double":
            return self._on_step(min(self.high, max(self.low, round(value, self._digits()))))
        whole = min(math.floor(self.high), max(math.ceil(self.low), round(value)))
        return bool(whole) if self.kind == "bool" else self._on_step(whole)

    def _on_step(self, value: TunableValue) -> TunableValue:
        """The nearest value in the range that the node accepts; the same value if there is none."""
        allowed, whole = self.allowed, self.kind == "integer"
        if allowed is None or not allowed.step or not allowed.finite:
            return value
        found = allowed.at_share(allowed.share(value), whole=whole)
        if found is not None and not self.low <= found <= self.high:
            found = allowed.moved(found, -1 if found > self.high else 1, whole=whole)
        return found if found is not None and self.low <= found <= self.high else value

    @property
    def _points(self) -> int:
        """The number of points of the descriptor's grid in the range; 0 if it has no step."""
        allowed = self.allowed
        if allowed is None or not (allowed.step and math.isfinite(allowed.step) and allowed.finite):
            return 0
        step = abs(allowed.step)
        return math.floor((self.high - allowed.low) / step) - math.ceil((self.low - allowed.low) / step) + 1

    def share(self, value: TunableValue) -> float:
        """The position of a value in the range, 0 to 1; 0.5 if the range is a single value."""
        span = self.high - self.low
        return min(1.0, max(0.0, (float(value) - self.low) / span)) if span else 0.5

    def between(self, low: float, high: float) -> Tunable:
        """The tunable with a narrower range; raises `ValueError` if that is empty or exceeds the present one."""
        if not (math.isfinite(low) and math.isfinite(high) and low <= high):
            raise ValueError(f"{self.name}: {low:g}..{high:g} is not a range; the lower end comes first")
        if low < self.low or high > self.high:
            raise ValueError(f"{self.name}: {low:g}..{high:g} leaves its range, {self.low:g}..{self.high:g}")
        narrowed = replace(self, low=low, high=high)
        if narrowed.levels < 1:
            raise ValueError(f"{self.name}: there is no whole number from {low:g} to {high:g}")
        return narrowed

    def _digits(self) -> int:
        span = self.high - self.low
        return max(0, math.ceil(math.log10(MIN_VALUES) - math.log10(span))) if span > 0 else 12


def parse_range(text: str) -> tuple[float, float]:
    """The ends of `LOW..HIGH`; raises `ValueError`."""
    low, dots, high = text.partition("..")
    try:
        if dots:
            return float(low), float(high)
    except ValueError:
        pass
    raise ValueError(f"'{text}' is not a range; write for instance 0.2..1.5")


def find_tunables(words: list[str], known: list[Tunable]) -> tuple[Tunable, ...]:
    """The tunables that words stand for: `name`, `/node:name`, either with `=LOW..HIGH`.

    Raises `ValueError` for a word that matches none or several, or a parameter without a range.
    """
    found: list[Tunable] = []
    for word in words:
        label, given, span = word.partition("=")
        tunable = _matching(label.strip(), known)
        if given:
            low, high = parse_range(span)
            tunable = tunable.between(low, high)
        elif not (math.isfinite(tunable.low) and math.isfinite(tunable.high)):
            raise ValueError(f"{tunable.label} has no range in its descriptor; give one: {label}=LOW..HIGH")
        if any(each.label == tunable.label for each in found):
            raise ValueError(f"{tunable.label} is given twice")
        found.append(tunable)
    if not found:
        raise ValueError("name at least one parameter, for instance max_speed or max_speed=0.5..2")
    return tuple(found)


def _matching(label: str, known: list[Tunable]) -> Tunable:
    node, colon, name = label.rpartition(":")
    fitting = [each for each in known if each.name == name and (not colon or _is_node(each.node, node))]
    if len(fitting) > 1:
        raise ValueError(f"several nodes have {name}: say which, {' or '.join(each.label for each in fitting)}")
    if not fitting:
        names = ", ".join(sorted({each.name for each in known})) or "none"
        raise ValueError(f"no node has a number or boolean '{label}' that can be set; there are: {names}")
    return fitting[0]


def _is_node(node: str, typed: str) -> bool:
    return node.lstrip("/") == typed.lstrip("/")
