"""Thresholds that the user sets for a curve; values beyond one are marked."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from bot_console.tui.text.expression.numbers import evaluate


@dataclass(frozen=True)
class Threshold:
    """A value that a curve should not be above, or below."""

    value: float
    above: bool = True

    def crossed(self, value: float | None) -> bool:
        """Whether a value is beyond the threshold; False for None."""
        return value is not None and (value > self.value if self.above else value < self.value)

    @property
    def text(self) -> str:
        """The threshold as the user would type it."""
        return f"{'>' if self.above else '<'} {self.value:g}"


def thresholds_of(text: str) -> tuple[Threshold, ...]:
    """Parse thresholds such as `> 1.5, < 0.2`; raises `ValueError` that says how to write them."""
    found: list[Threshold] = []
    for part in filter(None, (each.strip() for each in text.split(","))):
        match = re.fullmatch(r"([<>])=?\s*(.+)", part)
        if match is None:
            raise ValueError("write thresholds such as > 1.5, < 0.2")
        found.append(Threshold(float(evaluate(match[2])), match[1] == ">"))
    return tuple(found)


def thresholds_problem(text: str) -> str:
    """The problem with typed thresholds; empty if there is none."""
    try:
        thresholds_of(text)
    except ValueError as error:
        return str(error)
    return ""


def thresholds_text(thresholds: Sequence[Threshold]) -> str:
    """The thresholds as the user would type them."""
    return ", ".join(each.text for each in thresholds)


def first_crossed(thresholds: Iterable[Threshold], value: float | None) -> Threshold | None:
    """The first threshold that a value is beyond; None if there is none."""
    return next((each for each in thresholds if each.crossed(value)), None)
