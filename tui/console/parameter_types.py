"""The parameter types, with the Python type of each and the kind of an array's elements."""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.console.model import Kind


@dataclass(frozen=True)
class Type:
    """A parameter type other than NOT_SET."""

    python: type
    """The Python type of a value, or of each element of an array."""

    element: Kind | None = None
    """The kind in which a user writes an element; None if the type is not an array."""


TYPES = {
    Kind.BOOL: Type(bool),
    Kind.INTEGER: Type(int),
    Kind.DOUBLE: Type(float),
    Kind.STRING: Type(str),
    Kind.BYTE_ARRAY: Type(bytes, Kind.INTEGER),
    Kind.BOOL_ARRAY: Type(bool, Kind.BOOL),
    Kind.INTEGER_ARRAY: Type(int, Kind.INTEGER),
    Kind.DOUBLE_ARRAY: Type(float, Kind.DOUBLE),
    Kind.STRING_ARRAY: Type(str, Kind.STRING),
}

ARRAYS = {kind: row.element for kind, row in TYPES.items() if row.element is not None}
"""The kind in which users write the elements, for each kind of array."""


def field_of(kind: Kind) -> str:
    """The field of `rcl_interfaces/msg/ParameterValue` that contains values of this kind."""
    return f"{kind.name.lower()}_value"
