"""The standard interfaces at build time: messages from rosbags' type store for Jazzy, the rest from our definitions."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bot_console.runtime.rosidl.definition import PRIMITIVES, Constant, Definition, Field, Interface, Type
from bot_console.runtime.rosidl.parse import parse
from bot_console.runtime.rosidl.write import to_text

FOLDER = Path(__file__).resolve().parent / "definitions"
EMPTY = "structure_needs_at_least_one_member"


def interfaces() -> Iterator[tuple[Interface, str]]:
    """Yield all standard interfaces with their text; our definitions take precedence over the type store's."""
    ours = list(_ours())
    known = {(each.package, each.kind, each.name) for each, _ in ours}
    yield from ours
    for each in _from_store():
        if (each.package, each.kind, each.name) not in known:
            yield each, to_text(each)


def _ours() -> Iterator[tuple[Interface, str]]:
    for path in sorted(FOLDER.glob("*/*/*.*")):
        kind = path.suffix[1:]
        text = path.read_text(encoding="utf-8")
        yield parse(text, path.parts[-3], kind, path.stem, str(path)), text


def _from_store() -> Iterator[Interface]:
    from rosbags.typesys import Stores, get_typestore

    for full_name, (constants, fields) in get_typestore(Stores.ROS2_JAZZY).fielddefs.items():
        package, _, name = full_name.partition("/msg/")
        rows = [_field(*each) for each in fields if each[0] != EMPTY]
        yield Interface(package, "msg", name, [Definition(name, rows, [_constant(*each) for each in constants])])


def _constant(name: str, kind: str, value: object) -> Constant:
    literal = repr(bytes([value]) if kind == "byte" and isinstance(value, int) else value)
    return Constant(name, literal, kind)


def _field(name: str, description: Any) -> Field:
    shape, inside = description
    if shape.name == "BASE":
        kind = _single(inside)
    elif shape.name == "NAME":
        kind = Type(inside.replace("/msg/", "/"))
    else:
        (inner_shape, inner), count = inside
        item = _single(inner) if inner_shape.name == "BASE" else Type(inner.replace("/msg/", "/"))
        sequence = shape.name == "SEQUENCE"
        kind = Type(item.item, sequence, count if sequence else 0, 0 if sequence else count, item.limit)
    return Field(name, kind)


def _single(base: tuple[str, int]) -> Type:
    return Type(PRIMITIVES[base[0]], limit=base[1] if base[0] == "string" else 0)
