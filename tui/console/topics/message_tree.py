"""Converts a message to lines: nested fields, summaries of long arrays, names of enumerators. Pure functions."""

from __future__ import annotations

from typing import Any

import numpy as np
from bot_console.tui.console.topics.angles import angles_text
from bot_console.tui.console.topics.field_units import field_unit
from bot_console.tui.console.topics.interfaces import (
    INTEGERS,
    QUATERNION,
    REALS,
    TIMES,
    constants,
    element_type,
    fields_of,
    is_message,
    short_name,
)
from bot_console.tui.console.topics.port import Field

MAX_ELEMENTS = 8
"""Maximum number of array elements shown on separate lines, or together on one line."""
MAX_FIELDS = 2000
"""Maximum number of lines for a message; a single line stands for the rest."""
MAX_TEXT_CHARACTERS = 400
"""Characters shown of a string."""


def tree(message: Any, type_name: str) -> tuple[Field, ...]:
    """The lines for a message of a type (`package/msg/Name`)."""
    lines = _fields(message, short_name(type_name), "", 0, "", [MAX_FIELDS])
    return tuple(lines)


def _fields(message: Any, type_name: str, path: str, depth: int, unit: str, left: list[int]) -> list[Field]:
    found: list[Field] = []
    named = constants(message)
    for name, kind in fields_of(message).items():
        left[0] -= 1
        if left[0] < 0:
            return [*found, Field(path, "...", depth, "", "more fields than can be shown")]
        value = getattr(message, name)
        place = f"{path}.{name}" if path else name
        own = field_unit(type_name, name, unit)
        if is_message(kind):
            found += _nested(value, kind, name, place, depth, own, left)
        elif element := element_type(kind):
            found += _array(message, value, (kind, element), name, place, depth, own, left)
        else:
            text = scalar_text(value, named.get(name, {}))
            found.append(Field(place, name, depth, kind, text, own, kind in INTEGERS or kind in (*REALS, "boolean")))
    return found


def _nested(value: Any, kind: str, name: str, path: str, depth: int, unit: str, left: list[int]) -> list[Field]:
    inside = _fields(value, kind, path, depth + 1, unit, left)
    text = ""
    if kind in TIMES:
        text, unit = f"{value.sec + value.nanosec / 1e9:.3f}", "s"
    elif kind == QUATERNION:
        text = angles_text(value)
    head = Field(path, name, depth, kind, text, unit, holds=len(inside), closed=bool(text))
    return [head, *inside]


def _array(
    owner: Any, value: Any, kinds: tuple[str, str], name: str, path: str, depth: int, unit: str, left: list[int]
) -> list[Field]:
    kind, element = kinds
    if is_message(element):
        inside: list[Field] = []
        for at, each in enumerate(value[:MAX_ELEMENTS]):
            inside += _nested(each, element, f"[{at}]", f"{path}[{at}]", depth + 1, unit, left)
        if len(value) > MAX_ELEMENTS:
            inside.append(Field(path, "...", depth + 1, "", f"{len(value) - MAX_ELEMENTS} more elements"))
        text = "empty" if not len(value) else f"{len(value)} element{'s' if len(value) > 1 else ''}"
        return [Field(path, name, depth, kind, text, unit if len(value) else "", holds=len(inside)), *inside]
    number = element in INTEGERS or element in REALS
    return [Field(path, name, depth, kind, _summary(owner, name, value, element), unit if number else "")]


def _summary(owner: Any, name: str, value: Any, element: str) -> str:
    """An array of scalars on one line: all its elements if it is short, else statistics."""
    count = len(value)
    if name == "data" and hasattr(owner, "encoding") and hasattr(owner, "width"):
        return f"image of {owner.width} x {owner.height}, {owner.encoding}, {count} bytes"
    if name == "data" and hasattr(owner, "format"):
        return f"image, {owner.format or 'format unknown'}, {count} bytes"
    if count <= MAX_ELEMENTS:
        return "[" + ", ".join(scalar_text(each, {}) for each in value) + "]"
    if element not in INTEGERS and element not in REALS:
        return f"{count} values: " + ", ".join(scalar_text(each, {}) for each in value[:3]) + ", ..."
    numbers = np.asarray(value, float)
    finite = numbers[np.isfinite(numbers)]
    if not finite.size:
        return f"{count} values, none of them finite"
    with np.errstate(over="ignore", invalid="ignore"):  # the mean of values near the limits of a float may overflow
        text = f"{count} values, {finite.min():.4g} .. {finite.max():.4g}, mean {finite.mean():.4g}"
    return text + (f", {count - finite.size} not finite" if finite.size < count else "")


def scalar_text(value: Any, names: Any) -> str:
    """A number, string or boolean on one line; an enumerator with its name."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, bytes):
        value = value[0] if len(value) == 1 else value.hex()
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    if isinstance(value, str):
        return (
            value
            if len(value) <= MAX_TEXT_CHARACTERS
            else f"{value[:MAX_TEXT_CHARACTERS]}... ({len(value)} characters)"
        )
    known = names.get(int(value)) if names and not isinstance(value, str) else None
    return f"{value} {known}" if known else str(value)
