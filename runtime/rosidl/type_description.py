"""Type descriptions of interface classes as plain data, structured as
`type_description_interfaces/msg/TypeDescription`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from bot_console.runtime.rosidl.conversion import type_name
from bot_console.runtime.rosidl.definition import Type, parse_type
from bot_console.runtime.rosidl.slot_types import nested_class

NESTED = 1
IDS = {
    "int8": 2,
    "uint8": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float": 10,
    "double": 11,
    "boolean": 15,
    "octet": 16,
    "string": 17,
    "wstring": 18,
}
BOUNDED_TEXT = {"string": 21, "wstring": 22}
ARRAY, BOUNDED, UNBOUNDED = 48, 96, 144
"""Numbers that are added to the number of an element's type."""

FILLER = "structure_needs_at_least_one_member"
SERVICE_PARTS = (("request_message", "Request"), ("response_message", "Response"), ("event_message", "Event"))
ACTION_PARTS = (("goal", "Goal"), ("result", "Result"), ("feedback", "Feedback"))
ACTION_INSIDE = (
    ("send_goal_service", "SendGoalService"),
    ("get_result_service", "GetResultService"),
    ("feedback_message", "FeedbackMessage"),
)

Description = dict[str, Any]


def describe(cls: Any) -> Description:
    """Return the description of a message, service or action class, and of all types in it, sorted by name."""
    found: dict[str, Description] = {}
    _collect(cls, found)
    top = found.pop(type_name(cls))
    return {
        "type_description": top,
        "referenced_type_descriptions": [found[name] for name in sorted(found)],
    }


def _collect(cls: Any, found: dict[str, Description]) -> None:
    name = type_name(cls)
    if name in found:
        return
    rows: list[Description] = []
    found[name] = {"type_name": name, "fields": rows}
    for field, kind, inner in _fields(cls):
        rows.append({"name": field, "type": field_type(kind, type_name(inner) if inner is not None else "")})
        if inner is not None:
            _collect(inner, found)


def _fields(cls: object) -> Iterator[tuple[str, Type, Any]]:
    """Yield names and types of the fields, with the class of nested ones; services and actions count as structures."""
    for name, inner in _members(cls):
        yield name, Type("/"), inner
    texts: dict[str, str] | None = getattr(cls, "_fields_and_field_types", None)
    if texts is not None and not texts:
        yield FILLER, Type("uint8"), None
    for name, text in (texts or {}).items():
        kind = parse_type(text)
        yield name, kind, None if kind.primitive else nested_class(cls, kind.item)


def _members(cls: Any) -> Iterator[tuple[str, Any]]:
    if hasattr(cls, "Goal"):
        yield from ((name, getattr(cls, part)) for name, part in ACTION_PARTS)
        yield from ((name, getattr(cls.Impl, part)) for name, part in ACTION_INSIDE)
    elif hasattr(cls, "Request"):
        yield from ((name, getattr(cls, part)) for name, part in SERVICE_PARTS)


def field_type(kind: Type, nested: str) -> Description:
    """Return a field's type as in a description; `nested` is the full name of its message type, if any."""
    number = NESTED if nested else (BOUNDED_TEXT if kind.limit else IDS)[kind.item]
    if kind.sequence:
        number += BOUNDED if kind.bound else UNBOUNDED
    elif kind.size:
        number += ARRAY
    return {
        "type_id": number,
        "capacity": kind.bound or kind.size,
        "string_capacity": kind.limit,
        "nested_type_name": nested,
    }
