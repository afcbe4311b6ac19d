"""Which Python values each parameter type accepts, by the codes of `rcl_interfaces/msg/ParameterType`."""

from __future__ import annotations

from array import array
from collections.abc import Iterable
from typing import Any, cast

from bot_console.runtime.rmw.parameter_types import (
    ARRAYS,
    BY_CODE,
    DOUBLE_ARRAY,
    INTEGER_ARRAY,
    NOT_SET,
    SCALARS,
)

FIELDS = {code: each.field for code, each in BY_CODE.items()}
"""The field of `ParameterValue` that holds a value of each type."""

# tuples, because they are iterated over for each value that is declared or set
_SCALARS = tuple((each.python, each.code) for each in SCALARS)
_ELEMENTS = tuple((each.python, each.code) for each in ARRAYS)
_NUMERIC_LISTS = frozenset((INTEGER_ARRAY.code, DOUBLE_ARRAY.code))


def infer(value: object) -> int:
    """Return the parameter type of a value; an empty list is a byte array. Raises `TypeError` for any other value."""
    if value is None:
        return NOT_SET
    for kind, code in _SCALARS:
        if isinstance(value, kind):
            return code
    if not isinstance(value, (list, tuple, array)):
        raise TypeError(f"The given value is not one of the allowed types '{value}'.")
    items = cast("Iterable[Any]", value)
    for kind, code in _ELEMENTS:
        if all(isinstance(each, kind) for each in items):
            return code
    raise TypeError(f"The given value is not a list of one of the allowed types '{value}'.")


def value_fits(code: int, value: object) -> bool:
    """Whether a parameter of this type may hold the value."""
    if code == NOT_SET:
        return value is None
    kind = BY_CODE[code]
    if not kind.is_array:
        return isinstance(value, kind.python)
    sequences = (list, tuple, array) if code in _NUMERIC_LISTS else (list, tuple)
    if not isinstance(value, sequences):
        return False
    items = cast("Iterable[Any]", value)
    element = kind.python
    return all(isinstance(each, element) and (element is not bytes or len(each) == 1) for each in items)
