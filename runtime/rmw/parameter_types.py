"""The table of parameter types, by the codes of `rcl_interfaces/msg/ParameterType`."""

from __future__ import annotations

from typing import NamedTuple


class ParameterType(NamedTuple):
    """The type of a parameter value."""

    code: int
    name: str
    """Name in `rclpy.Parameter.Type`."""
    python: type
    """Python type of a value, or of each element of an array."""
    is_array: bool
    word: str
    """Name used by rcl and launch files."""
    shown: str
    """Name printed by `ros2 param`."""

    @property
    def field(self) -> str:
        """The field of `rcl_interfaces/msg/ParameterValue` that holds a value of this type."""
        return f"{self.name.lower()}_value"


NOT_SET = 0
BOOL = ParameterType(1, "BOOL", bool, False, "bool", "boolean")
INTEGER = ParameterType(2, "INTEGER", int, False, "integer", "integer")
DOUBLE = ParameterType(3, "DOUBLE", float, False, "double", "double")
STRING = ParameterType(4, "STRING", str, False, "string", "string")
BYTE_ARRAY = ParameterType(5, "BYTE_ARRAY", bytes, True, "byte_array", "byte array")
BOOL_ARRAY = ParameterType(6, "BOOL_ARRAY", bool, True, "bool_array", "boolean array")
INTEGER_ARRAY = ParameterType(7, "INTEGER_ARRAY", int, True, "integer_array", "integer array")
DOUBLE_ARRAY = ParameterType(8, "DOUBLE_ARRAY", float, True, "double_array", "double array")
STRING_ARRAY = ParameterType(9, "STRING_ARRAY", str, True, "string_array", "string array")

SCALARS = (BOOL, INTEGER, DOUBLE, STRING)
"""Booleans come first: in Python they are also integers."""
ARRAYS = (BYTE_ARRAY, BOOL_ARRAY, INTEGER_ARRAY, DOUBLE_ARRAY, STRING_ARRAY)
BY_CODE = {each.code: each for each in (*SCALARS, *ARRAYS)}
BY_CLASS = {each.python: each for each in SCALARS}


def word_of(value: object) -> str:
    """Return rcl's word for a scalar's type; for any other value, the name of its class."""
    found = BY_CLASS.get(type(value))
    return type(value).__name__ if found is None else found.word
