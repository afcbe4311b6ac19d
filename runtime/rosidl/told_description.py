"""Descriptions of interfaces from the texts of their definitions alone, before any class is made of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from bot_console.runtime.rosidl.definition import Definition, Type
from bot_console.runtime.rosidl.parse import PARTS, DefinitionError, parse
from bot_console.runtime.rosidl.type_description import FILLER, SERVICE_PARTS, Description, field_type

EVENT_INFO = "service_msgs/msg/ServiceEventInfo"
MESSAGE = Type("/")
"""What a message in a message is, whichever it is."""

Row = tuple[str, Type, str]
"""A field's name, its type, and the full name of the message it holds; empty for a primitive."""


def describe_texts(wanted: str, texts: Mapping[str, str]) -> Description:
    """The description of the message or service `wanted`, as `describe` gives it for its class.

    `texts` are definitions by the full names of their types, of all that it consists of. Raises `DefinitionError` for
    one that cannot be read, or is missing.
    """
    structures: dict[str, Sequence[Row]] = {}
    for name, text in texts.items():
        structures.update(_structures(name, text))
    found: dict[str, Description] = {}
    _collect(wanted, structures, found)
    top = found.pop(wanted)
    return {"type_description": top, "referenced_type_descriptions": [found[name] for name in sorted(found)]}


def _collect(name: str, structures: Mapping[str, Sequence[Row]], found: dict[str, Description]) -> None:
    if name in found:
        return
    if name not in structures:
        raise DefinitionError(f"the definition of {name} is missing")
    rows = structures[name]
    found[name] = {
        "type_name": name,
        "fields": [{"name": field, "type": field_type(kind, nested)} for field, kind, nested in rows],
    }
    for _, _, nested in rows:
        if nested:
            _collect(nested, structures, found)


def _structures(name: str, text: str) -> Iterator[tuple[str, Sequence[Row]]]:
    """The structures of one definition: a message is one, a service has parts and what holds them."""
    package, kind, short = name.split("/")
    if kind not in PARTS:
        raise DefinitionError(f"{name} is neither a message nor a service")
    interface = parse(text, package, kind, short)
    for part in interface.parts:
        yield f"{package}/{kind}/{part.name}", _rows(part)
    if kind == "srv":
        yield name, [(field, MESSAGE, f"{name}_{part}") for field, part in SERVICE_PARTS]
        one = Type("/", sequence=True, bound=1)
        yield (
            f"{name}_Event",
            [
                ("info", MESSAGE, EVENT_INFO),
                ("request", one, f"{name}_Request"),
                ("response", one, f"{name}_Response"),
            ],
        )


def _rows(part: Definition) -> list[Row]:
    rows = [(each.name, each.type, "" if each.type.primitive else _full(each.type.item)) for each in part.fields]
    return rows or [(FILLER, Type("uint8"), "")]


def _full(item: str) -> str:
    package, _, name = item.partition("/")
    return f"{package}/msg/{name}"
