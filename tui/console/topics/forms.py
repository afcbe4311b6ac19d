"""Forms for messages, requests and goals: their fields with values, and the messages filled in from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from bot_console.tui.console.topics.angles import angles_text
from bot_console.tui.console.topics.field_units import field_unit
from bot_console.tui.console.topics.interfaces import (
    HEADER,
    QUATERNION,
    TIMES,
    constants,
    element_type,
    fields_of,
    filled_class,
    is_message,
    short_name,
)
from bot_console.tui.console.topics.message_tree import scalar_text
from bot_console.tui.console.topics.port import Payload, Slot, Values
from bot_console.tui.console.topics.typed import NOW, parse
from rosidl_runtime_py import message_to_ordereddict

MAX_DEFAULT_CHARACTERS = 60
"""The maximum length, in characters, at which an array's default is written out."""


def slots(payload: Payload, type_name: str, values: Values) -> list[Slot]:
    """The fields of a type, in order, with the typed values or their defaults; raises `ValueError`."""
    message = filled_class(payload, type_name)()
    return list(_slots(message, short_name(type_name), "", 0, "", values))


def _slots(message: Any, type_name: str, path: str, depth: int, unit: str, values: Values) -> list[Slot]:
    found: list[Slot] = []
    named = constants(message)
    for name, kind in fields_of(message).items():
        if name == "structure_needs_at_least_one_member":
            continue
        value, place = getattr(message, name), f"{path}.{name}" if path else name
        own = field_unit(type_name, name, unit)
        if is_message(kind) and kind not in TIMES:
            is_turn = kind == QUATERNION
            text = values.get(place, angles_text(value) if is_turn else "")
            found.append(Slot(place, name, depth, kind, text, (), "" if is_turn else own, is_turn))
            if not (is_turn and place in values):
                found += _slots(value, kind, place, depth + 1, own, values)
            continue
        choices = tuple(f"{number} {word}" for number, word in sorted(named.get(name, {}).items()))
        text = values.get(place, _default(value, kind, type_name, named.get(name, {})))
        found.append(Slot(place, name, depth, kind, text, choices, "s" if kind in TIMES else own))
    return found


def _default(value: Any, kind: str, owner: str, names: Any) -> str:
    if kind in TIMES:
        return NOW if owner == HEADER else f"{value.sec + value.nanosec / 1e9:g}"
    if element_type(kind):
        text = (
            "[" + ", ".join(scalar_text(each, {}) for each in value) + "]"
            if not is_message(element_type(kind))
            else "[]"
        )
        return (
            text if len(text) <= MAX_DEFAULT_CHARACTERS else f"[{scalar_text(value[0], {})}, ... {len(value)} values]"
        )
    return scalar_text(value, names)


def field_at(message: Any, path: str) -> tuple[Any, str, str]:
    """The message that contains the field at a path, and the name and type of the field; raises `ValueError`."""
    *outer, name = path.split(".")
    for step in outer:
        if step not in fields_of(message):
            raise ValueError(f"there is no field {path}")
        message = getattr(message, step)
    if name not in fields_of(message):
        raise ValueError(f"there is no field {path}")
    return message, name, fields_of(message)[name]


def wrong(payload: Payload, type_name: str, path: str, text: str) -> str:
    """Why a text is not valid for a field; empty if it is."""
    try:
        _set_field(filled_class(payload, type_name)(), path, text)
    except ValueError as error:
        return str(error)
    return ""


def _set_field(message: Any, path: str, text: str) -> bool:
    """Set a field; returns whether it is a time that is to be set whenever the message is sent."""
    holder, name, kind = field_at(message, path)
    value = parse(kind, text, constants(holder).get(name, {}))
    if value is None:
        return True
    try:
        setattr(holder, name, value)
    except (AssertionError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: {error}") from None
    return False


def filled(payload: Payload, type_name: str, values: Values) -> tuple[Any, Sequence[str]]:
    """A message filled in with typed values, and the paths of the times that are `now`; raises `ValueError`."""
    message = filled_class(payload, type_name)()
    now = [each.path for each in slots(payload, type_name, values) if each.type in TIMES and each.text == NOW]
    for path, text in values.items():
        _set_field(message, path, text)
    return message, now


def stamp(message: Any, paths: Sequence[str], clock: Callable[[], Any]) -> None:
    """Set the fields at these paths to the current time."""
    for path in paths:
        holder, name, _ = field_at(message, path)
        setattr(holder, name, clock())


def typed_fields(payload: Payload, type_name: str, values: Values) -> dict[str, Any]:
    """The typed values as nested fields for a command line; times that are `now` stay the word `now`."""
    message, now = filled(payload, type_name, values)
    whole = message_to_ordereddict(message)
    found: dict[str, Any] = {}
    for path in (*values, *(each for each in now if each not in values)):
        steps = path.split(".")
        source, target = whole, found
        for step in steps[:-1]:
            source, target = source[step], target.setdefault(step, {})
        target[steps[-1]] = NOW if path in now else source[steps[-1]]
    return found
