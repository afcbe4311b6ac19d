"""Type descriptions received from other programs, before classes are made from them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from bot_console.runtime.rosidl.definition import Definition, Type
from bot_console.runtime.rosidl.parse import PARTS, DefinitionError, parse
from bot_console.runtime.rosidl.parts import companions
from bot_console.runtime.rosidl.type_description import (
    ACTION_PARTS,
    FILLER,
    SERVICE_PARTS,
    Description,
    field_type,
)

ACTION_TYPES = (
    ("send_goal_service", "SendGoal"),
    ("get_result_service", "GetResult"),
    ("feedback_message", "FeedbackMessage"),
)
"""The types by which action servers and clients match; each has its own type and hash in the graph."""
ACTION_SERVICES = ("SendGoal", "GetResult")
FIELD_TYPE = ("type_id", "capacity", "string_capacity", "nested_type_name")
"""The properties of a field's type that enter its hash, in order; defaults and comments do not."""
MESSAGE = Type("/")
"""A type that stands for any nested message."""

Row = tuple[str, Type, str]
"""A field's name, its type, and the full name of its message type; empty for a primitive."""


def describe_texts(wanted: str, texts: Mapping[str, str]) -> Description:
    """Return the description of the interface `wanted`, as `describe` would for its class.

    `texts` are the definitions of all its types, by full type name. Raises `DefinitionError` if one is invalid or
    missing.
    """
    structures: dict[str, Sequence[Row]] = {}
    for name, text in texts.items():
        structures.update(_structures(name, text))
    found: dict[str, Description] = {}
    _collect(wanted, structures, found)
    return _with_references(wanted, found)


def plain_description(reported: Any) -> Description:
    """Convert a `type_description_interfaces/msg/TypeDescription` to plain data."""
    return {
        "type_description": _plain(reported.type_description),
        "referenced_type_descriptions": [_plain(each) for each in reported.referenced_type_descriptions],
    }


def _plain(reported: Any) -> Description:
    return {
        "type_name": reported.type_name,
        "fields": [
            {"name": each.name, "type": {name: getattr(each.type, name) for name in FIELD_TYPE}}
            for each in reported.fields
        ],
    }


def describe_action(wanted: str, parts: Iterable[Description]) -> Description:
    """Return the description of an action from those of its `ACTION_TYPES`, whose hashes are in the graph.

    The action itself is not in the graph; its hash follows from those of its parts. Raises `DefinitionError` if a type
    of the action is missing from them.
    """
    found = {each["type_name"]: each for part in parts for each in _all(part)}
    rows = _action_rows(wanted)
    found[wanted] = _description(wanted, rows)
    missing = [nested for _, _, nested in rows if nested not in found]
    if missing:
        raise DefinitionError(f"the definition of {missing[0]} is missing")
    return _with_references(wanted, found)


def _all(description: Description) -> Iterator[Description]:
    yield description["type_description"]
    yield from description["referenced_type_descriptions"]


def _with_references(wanted: str, found: dict[str, Description]) -> Description:
    top = found.pop(wanted)
    return {"type_description": top, "referenced_type_descriptions": [found[name] for name in sorted(found)]}


def _collect(name: str, structures: Mapping[str, Sequence[Row]], found: dict[str, Description]) -> None:
    if name in found:
        return
    if name not in structures:
        raise DefinitionError(f"the definition of {name} is missing")
    rows = structures[name]
    found[name] = _description(name, rows)
    for _, _, nested in rows:
        if nested:
            _collect(nested, structures, found)


def _description(name: str, rows: Sequence[Row]) -> Description:
    return {
        "type_name": name,
        "fields": [{"name": field, "type": field_type(kind, nested)} for field, kind, nested in rows],
    }


def _structures(name: str, text: str) -> Iterator[tuple[str, Sequence[Row]]]:
    """Yield the structures of one definition: one for a message, parts and their containers for others."""
    package, kind, short = name.split("/")
    if kind not in PARTS:
        raise DefinitionError(f"{name} is not an interface")
    interface = parse(text, package, kind, short)
    for part in (*interface.parts, *companions(interface)):
        yield f"{package}/{kind}/{part.name}", _rows(part, kind)
    if kind == "srv":
        yield name, _service_rows(name)
    elif kind == "action":
        yield name, _action_rows(name)
        for service in ACTION_SERVICES:
            yield f"{name}_{service}", _service_rows(f"{name}_{service}")


def _service_rows(name: str) -> list[Row]:
    return [(field, MESSAGE, f"{name}_{part}") for field, part in SERVICE_PARTS]


def _action_rows(name: str) -> list[Row]:
    return [(field, MESSAGE, f"{name}_{part}") for field, part in (*ACTION_PARTS, *ACTION_TYPES)]


def _rows(part: Definition, kind: str) -> list[Row]:
    rows = [(each.name, each.type, "" if each.type.primitive else _full(each.type.item, kind)) for each in part.fields]
    return rows or [(FILLER, Type("uint8"), "")]


def _full(item: str, kind: str) -> str:
    """Return the full name of a field's message type; only the parts of a definition of this `kind` have an
    underscore.
    """
    package, _, name = item.partition("/")
    return f"{package}/{kind if '_' in name else 'msg'}/{name}"
