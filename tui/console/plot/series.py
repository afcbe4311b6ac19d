"""Samples of a plotted value: a bounded ring of (time, value), read by cursor; and paths into messages."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

import numpy as np
from bot_console.tui.console.protocol import Samples

STEP = re.compile(r"([A-Za-z_]\w*)|\[(-?\d+)\]")


class Series:
    """A ring of samples; times in s, one cursor step for each sample."""

    def __init__(self, capacity: int = 20_000) -> None:
        self._times = np.zeros(capacity)
        self._values = np.zeros(capacity)
        self._capacity = capacity
        self._end = 0

    def add(self, time: float, value: float) -> None:
        """Append one sample; the oldest falls out of a full ring."""
        at = self._end % self._capacity
        self._times[at] = time
        self._values[at] = value
        self._end += 1

    def after(self, cursor: int) -> Samples:
        """Samples from the cursor on, oldest first."""
        end = self._end
        begin = max(cursor, end - self._capacity, 0)
        where = np.arange(begin, end) % self._capacity
        return Samples(self._times[where], self._values[where], end)  # type: ignore[arg-type] -- numpy numbers count as numbers


class NotPlottable(Exception):
    """A path that cannot be plotted; the text says why."""


def parse_steps(text: str) -> tuple[str | int, ...]:
    """The steps of a field path such as `linear.x`, `pose/position.x` or `ranges[3]`; raises `NotPlottable`."""
    steps: list[str | int] = []
    for part in re.split(r"[./]", text):
        whole = 0
        for match in STEP.finditer(part):
            if match.start() != whole:
                break
            whole = match.end()
            steps.append(match[1] if match[1] else int(match[2]))
        if whole != len(part) or not part:
            raise NotPlottable(f"'{text}' is not a field path; write for instance linear.x or ranges[0]")
    return tuple(steps)


def reader(steps: Sequence[str | int]) -> Callable[[Any], float]:
    """A function that takes a message to the number at the path; it raises `NotPlottable` where there is none."""

    def read(message: Any) -> float:
        value = message
        for step in steps:
            value = _follow(value, step)
        if isinstance(value, (bool, int, float, np.number)):
            return float(cast("float", value))
        if isinstance(value, bytes) and len(value) == 1:
            return float(value[0])
        raise NotPlottable(f"{_name(steps)} is {_kind(value)}, not a number")

    return read


def _follow(value: Any, step: str | int) -> Any:
    if isinstance(step, int):
        try:
            return value[step]
        except (IndexError, TypeError, KeyError):
            raise NotPlottable(f"there is no element [{step}]") from None
    known: Mapping[str, str] = getattr(value, "get_fields_and_field_types", dict)()
    if step not in known:
        fields = ", ".join(known) or "none"
        raise NotPlottable(f"no field '{step}'; fields here: {fields}")
    return getattr(value, step)


def _kind(value: Any) -> str:
    if hasattr(value, "get_fields_and_field_types"):
        return "a message with the fields " + ", ".join(value.get_fields_and_field_types())
    if isinstance(value, str):
        return "text"
    return "an array; add [0] for its first element" if hasattr(value, "__len__") else f"of type {type(value).__name__}"


def _name(steps: Sequence[str | int]) -> str:
    return "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps).lstrip(".") or "the message"
