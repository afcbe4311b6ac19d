"""Limits that a person sets for a curve; values beyond one are marked and announced."""

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
        """Whether a value lies beyond."""
        return value is not None and (value > self.value if self.above else value < self.value)

    @property
    def text(self) -> str:
        """As it is typed."""
        return f"{'>' if self.above else '<'} {self.value:g}"


def thresholds_of(text: str) -> tuple[Threshold, ...]:
    """The thresholds in a text such as `> 1.5, < 0.2`; empty for an empty text; raises `ValueError` with the remedy."""
    found: list[Threshold] = []
    for part in filter(None, (each.strip() for each in text.split(","))):
        match = re.fullmatch(r"([<>])=?\s*(.+)", part)
        if match is None:
            raise ValueError("write thresholds such as > 1.5, < 0.2")
        found.append(Threshold(float(evaluate(match[2])), match[1] == ">"))
    return tuple(found)


def wrong_thresholds(text: str) -> str:
    """The problem with typed thresholds; empty if there is none."""
    try:
        thresholds_of(text)
    except ValueError as error:
        return str(error)
    return ""


def thresholds_text(thresholds: Sequence[Threshold]) -> str:
    """As they are typed."""
    return ", ".join(each.text for each in thresholds)


def first_crossed(thresholds: Iterable[Threshold], value: float | None) -> Threshold | None:
    """The first that a value lies beyond."""
    return next((each for each in thresholds if each.crossed(value)), None)
