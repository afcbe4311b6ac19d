"""Which Python values stand for which type of parameter, by the codes of `rcl_interfaces/msg/ParameterType`."""

from __future__ import annotations

from array import array
from typing import Any

NOT_SET, BOOL, INTEGER, DOUBLE, STRING, BYTE_ARRAY, BOOL_ARRAY, INTEGER_ARRAY, DOUBLE_ARRAY, STRING_ARRAY = range(10)

FIELDS = {
    BOOL: "bool_value",
    INTEGER: "integer_value",
    DOUBLE: "double_value",
    STRING: "string_value",
    BYTE_ARRAY: "byte_array_value",
    BOOL_ARRAY: "bool_array_value",
    INTEGER_ARRAY: "integer_array_value",
    DOUBLE_ARRAY: "double_array_value",
    STRING_ARRAY: "string_array_value",
}
"""The field of `ParameterValue` that holds a value of each type."""

LIST_FIELDS = frozenset((BYTE_ARRAY, BOOL_ARRAY, INTEGER_ARRAY, DOUBLE_ARRAY, STRING_ARRAY))

# bool is an int, therefore it comes first.
_SCALARS: tuple[tuple[Any, int], ...] = ((bool, BOOL), (int, INTEGER), (float, DOUBLE), (str, STRING))
_ELEMENTS: tuple[tuple[Any, int], ...] = (
    (bytes, BYTE_ARRAY),
    (bool, BOOL_ARRAY),
    (int, INTEGER_ARRAY),
    (float, DOUBLE_ARRAY),
    (str, STRING_ARRAY),
)
_SCALAR_CLASSES: dict[int, Any] = {code: kind for kind, code in _SCALARS}
_ELEMENT_CLASSES: dict[int, Any] = {code: kind for kind, code in _ELEMENTS}
_NUMERIC_LISTS = frozenset((INTEGER_ARRAY, DOUBLE_ARRAY))


def infer(value: Any) -> int:
    """The type that a value stands for; an empty list is a byte array. Raises `TypeError` where it stands for none."""
    if value is None:
        return NOT_SET
    for kind, code in _SCALARS:
        if isinstance(value, kind):
            return code
    if not isinstance(value, (list, tuple, array)):
        raise TypeError(f"The given value is not one of the allowed types '{value}'.")
    for kind, code in _ELEMENTS:
        if all(isinstance(each, kind) for each in value):
            return code
    raise TypeError(f"The given value is not a list of one of the allowed types '{value}'.")


def value_fits(code: int, value: Any) -> bool:
    """Whether a parameter of a type may hold the value."""
    if code == NOT_SET:
        return value is None
    kind = _SCALAR_CLASSES.get(code)
    if kind is not None:
        return isinstance(value, kind)
    sequences = (list, tuple, array) if code in _NUMERIC_LISTS else (list, tuple)
    if not isinstance(value, sequences):
        return False
    element = _ELEMENT_CLASSES[code]
    return all(isinstance(each, element) and (element is not bytes or len(each) == 1) for each in value)
