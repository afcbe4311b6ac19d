"""How a message lies in CDR: runs of numbers between the parts whose length is only known when they are read."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any, NamedTuple

from bot_console.runtime.rosidl.definition import Type, parse_type
from bot_console.runtime.rosidl.slot_types import nested_class

CODES = {
    "boolean": "?",
    "octet": "c",
    "float": "f",
    "double": "d",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
}
"""Codes of `struct` by element type."""

FILLER = ""
"""Name of the byte by which a structure without fields is sent."""


class Part(NamedTuple):
    """A field by its path from the outermost message; `owner` is the class that has it."""

    path: tuple[str, ...]
    type: Type
    owner: Any

    @property
    def number(self) -> bool:
        """Whether its length is known and it is no array."""
        return self.type.item in CODES and not self.type.sequence and not self.type.size


def parts(cls: Any, path: tuple[str, ...] = ()) -> Iterator[Part]:
    """The fields of a message class in the order of the wire, those of nested messages in the place of these."""
    fields = cls._fields_and_field_types
    if not fields:
        yield Part((*path, FILLER), Type("uint8"), cls)
    for name, text in fields.items():
        kind = parse_type(text)
        if kind.primitive or kind.sequence or kind.size:
            yield Part((*path, name), kind, cls)
        else:
            yield from parts(nested_class(cls, kind.item), (*path, name))


def nested(cls: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Any]]:
    """The single nested messages, outer ones first, by their path."""
    for name, text in cls._fields_and_field_types.items():
        kind = parse_type(text)
        if not (kind.primitive or kind.sequence or kind.size):
            inner = nested_class(cls, kind.item)
            yield (*path, name), inner
            yield from nested(inner, (*path, name))


def runs(cls: Any) -> Iterator[Sequence[Part]]:
    """The parts, with neighbouring numbers in one group."""
    group: list[Part] = []
    for part in parts(cls):
        if part.number:
            group.append(part)
            continue
        if group:
            yield group
            group = []
        yield [part]
    if group:
        yield group


@cache
def aligned(codes: str, order: str) -> tuple[struct.Struct, ...]:
    """Structures for numbers in a row, one for each place modulo 8 at which the first may lie."""
    found: list[struct.Struct] = []
    for start in range(8):
        place, text = start, order
        for code in codes:
            size = struct.calcsize(order + code)
            gap = -place % size
            text += "x" * gap + code
            place += gap + size
        found.append(struct.Struct(text))
    return tuple(found)


def compiled(source: str, names: dict[str, Any], title: str) -> Callable[..., Any]:
    """The function `f` of a source text that this package has written itself."""
    exec(compile(source, f"<{title}>", "exec"), names)
    return names["f"]
