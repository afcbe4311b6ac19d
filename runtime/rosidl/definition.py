"""The model of an interface: fields, constants and defaults, independent of the notation."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

PRIMITIVES = {
    "bool": "boolean",
    "boolean": "boolean",
    "byte": "octet",
    "octet": "octet",
    "char": "uint8",
    "float32": "float",
    "float": "float",
    "float64": "double",
    "double": "double",
    "int8": "int8",
    "uint8": "uint8",
    "int16": "int16",
    "uint16": "uint16",
    "int32": "int32",
    "uint32": "uint32",
    "int64": "int64",
    "uint64": "uint64",
    "string": "string",
    "wstring": "wstring",
}
"""Type names in definition files, and the corresponding ones of `get_fields_and_field_types`."""

WRITTEN = {name: name for name in PRIMITIVES.values()} | {
    "boolean": "bool",
    "octet": "byte",
    "float": "float32",
    "double": "float64",
}
"""The usual name in definition files, by the name in `get_fields_and_field_types`."""

TYPECODES = {
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
"""Typecodes of `array.array` by element type; other sequences are lists."""

DTYPES = {"float": "float32", "double": "float64", **{name: name for name in TYPECODES if "int" in name}}
"""NumPy dtypes of fixed-size arrays by element type; other fixed-size arrays are lists."""

INTEGERS = tuple(name for name in TYPECODES if "int" in name)
SHAPES = r"^(?:sequence<(?P<item>.+?)(?:, (?P<bound>\d+))?>|(?P<fixed>.+?)\[(?P<size>\d+)\])$"
BOUNDED = r"^(w?string)<(\d+)>$"


class Type(NamedTuple):
    """A field's type: an element type, alone, in a sequence (`bound` 0 means unbounded) or in an array of fixed size.

    `item` is a primitive's name or `package/Name`; `limit` is the maximum length of a string, 0 if there is none.
    """

    item: str
    sequence: bool = False
    bound: int = 0
    size: int = 0
    limit: int = 0

    @property
    def primitive(self) -> bool:
        """Whether the element is a primitive rather than a message."""
        return "/" not in self.item

    @property
    def text(self) -> str:
        """The type in the notation of `get_fields_and_field_types`."""
        item = f"{self.item}<{self.limit}>" if self.limit else self.item
        if self.sequence:
            return f"sequence<{item}, {self.bound}>" if self.bound else f"sequence<{item}>"
        return f"{item}[{self.size}]" if self.size else item


class Field(NamedTuple):
    """A field with the Python literal of its default; None for the type's own default."""

    name: str
    type: Type
    default: str | None = None


class Constant(NamedTuple):
    """A constant, the Python literal of its value, and its type as definition files write it."""

    name: str
    value: str
    type: str = ""


class Definition(NamedTuple):
    """A message, or one part of a service or action such as `SetBool_Request`."""

    name: str
    fields: Sequence[Field]
    constants: Sequence[Constant] = ()


class Interface(NamedTuple):
    """An interface: `kind` is msg, srv or action; a service has two parts and an action three."""

    package: str
    kind: str
    name: str
    parts: Sequence[Definition]


def parse_type(text: str) -> Type:
    """Parse a type in the notation of `get_fields_and_field_types`."""
    if not text.endswith((">", "]")):  # most fields; short-lived programs then compile no pattern
        return Type(text)
    match = re.match(SHAPES, text)
    item = (match["item"] or match["fixed"]) if match else text
    string = re.match(BOUNDED, item)
    return Type(
        string[1] if string else item,
        sequence=bool(match and match["item"]),
        bound=int(match["bound"] or 0) if match else 0,
        size=int(match["size"] or 0) if match else 0,
        limit=int(string[2]) if string else 0,
    )
