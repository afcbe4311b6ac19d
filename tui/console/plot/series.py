"""Stores the values of a series in a ring buffer that is read by cursor, and parses paths into messages."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias, cast

import numpy as np
from bot_console.tui.console.plot.arrays import NotPlottable, make
from bot_console.tui.console.plot.port import Samples
from bot_console.tui.text.expression.tree import OF_ARRAYS

STEP = re.compile(r"([A-Za-z_]\w*)|\[(-?\d+)\]|\[(-?\d*):(-?\d*)\]")
Step: TypeAlias = "str | int | slice[int | None]"


class Series:
    """A ring buffer of samples; times are in s, and the cursor advances by one per sample."""

    def __init__(self, capacity: int = 20_000) -> None:
        self._samples = np.zeros((3, capacity))
        self._capacity = capacity
        self._end = 0

    def add(self, time: float, value: float, header: float = math.nan) -> None:
        """Append a sample, with the time in its message's header; when the ring is full, the oldest is dropped."""
        self._samples[:, self._end % self._capacity] = (time, value, header)
        self._end += 1

    def after(self, cursor: int) -> Samples:
        """The samples from the cursor on, oldest first."""
        end = self._end
        begin = max(cursor, end - self._capacity, 0)
        times, values, headers = self._samples[:, np.arange(begin, end) % self._capacity]
        return Samples(times, values, end, headers=headers)  # type: ignore[arg-type] -- numpy numbers count as numbers


def parse_path(text: str) -> tuple[tuple[Step, ...], str]:
    """The steps of a field path, and the function applied to the array at its end, if any; raises `NotPlottable`.

    Examples: `linear.x`, `pose/position.x`, `ranges[3]`, `ranges[10:20].min()`.
    """
    path, dot, made = text.rpartition(".")
    if not (dot and made.endswith("()")):
        return parse_steps(text), ""
    if made[:-2] not in OF_ARRAYS:
        raise NotPlottable(f"the functions of an array are {', '.join(OF_ARRAYS)}, not {made[:-2] or 'nothing'}")
    return parse_steps(path), made[:-2]


def parse_steps(text: str) -> tuple[Step, ...]:
    """Parse a field path into steps; raises `NotPlottable`."""
    steps: list[Step] = []
    for part in re.split(r"[./]", text):
        whole = 0
        for match in STEP.finditer(part):
            if match.start() != whole:
                break
            whole = match.end()
            steps.append(_step(match))
        if whole != len(part) or not part:
            raise NotPlottable(f"'{text}' is not a field path; write for instance linear.x or ranges[0]")
    return tuple(steps)


def _step(match: re.Match[str]) -> Step:
    if match[1]:
        return match[1]
    try:
        if match[2]:
            return int(match[2])
        return slice(*(int(each) if each.strip("-") else None for each in (match[3], match[4])))
    except ValueError:
        raise NotPlottable(f"{match[0][:20]} is too large a number") from None


def reader(steps: Sequence[Step], made: str = "") -> Callable[[Any], float]:
    """A function that returns the number at a path in a message; it raises `NotPlottable` if there is none."""

    def read(message: Any) -> float:
        value = message
        for step in steps:
            value = _follow(value, step)
        if made:
            return make(value, made, _name(steps))
        if isinstance(value, (bool, int, float, np.number)):
            return float(cast("float", value))
        if isinstance(value, bytes) and len(value) == 1:
            return float(value[0])
        raise NotPlottable(f"{_name(steps)} is {_kind(value)}, not a number")

    return read


def _follow(value: Any, step: Step) -> Any:
    if not isinstance(step, str):
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
    return (
        "an array; add [0] for its first element, or .mean() or .min()"
        if hasattr(value, "__len__")
        else f"of type {type(value).__name__}"
    )


def _name(steps: Sequence[Step]) -> str:
    return "".join(f".{step}" if isinstance(step, str) else "[…]" for step in steps).lstrip(".") or "the message"
