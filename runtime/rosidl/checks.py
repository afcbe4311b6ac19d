"""Field checks with Jazzy's messages; enabled by `check_fields=True` or `ROS_PYTHON_CHECK_FIELDS=1`."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Sequence, Set
from functools import lru_cache
from typing import Any, cast

from bot_console.runtime.rosidl.definition import DTYPES, INTEGERS, TYPECODES, Type, parse_type
from bot_console.runtime.rosidl.emit_copy import LIMITS
from bot_console.runtime.rosidl.slot_types import nested_class

BOUNDS = {"float": (3.402823466e38, "3.402823466e+38"), "double": (1.7976931348623157e308, "1.7976931348623157e+308")}
PYTHON = {"boolean": bool, "octet": bytes, "string": str, "wstring": str, "float": float, "double": float}
cached_type = lru_cache(None)(parse_type)


def check(owner: Any, field: str, value: Any) -> bool:
    """Raise `AssertionError` unless a value fits a field; return whether it is an array that the field can keep."""
    kind = cached_type(owner._fields_and_field_types[field])
    if kind.sequence or kind.size:
        if kind.item in TYPECODES and _is_kept(kind, field, value):
            return True
        _many(kind, owner, field, value)
    else:
        _one(kind, owner, field, value)
    return False


def _class(kind: Type, owner: object) -> Any:
    if not kind.primitive:
        return nested_class(owner, kind.item)
    return PYTHON.get(kind.item, int)


def _one(kind: Type, owner: object, field: str, value: object) -> None:
    cls = _class(kind, owner)
    if not kind.primitive:
        assert isinstance(value, cls), f"The '{field}' field must be a sub message of type '{cls.__name__}'"
    elif kind.item == "octet":
        fits = isinstance(value, (bytes, bytearray)) and len(value) == 1
        assert fits, f"The '{field}' field must be of type 'bytes' or 'ByteString' with length 1"
    elif kind.limit:
        fits = isinstance(value, str) and len(value) <= kind.limit
        assert fits, f"The '{field}' field must be string value not longer than {kind.limit}"
    else:
        assert isinstance(value, cls), f"The '{field}' field must be of type '{cls.__name__}'"
        fits, words = _range(kind, "{}")
        assert fits(value), f"The '{field}' field must be {words}"


def _range(kind: Type, number: str) -> tuple[Callable[[Any], bool], str]:
    """Return a test whether a number is in the range of its type, and the range's name; `number` formats the bounds."""
    if kind.item in INTEGERS:
        low, high = LIMITS[kind.item]
        word = "an integer" if low else "an unsigned integer"
        return (lambda value: low <= value <= high), f"{word} in [{low}, {high}]"
    if kind.item in BOUNDS:
        bound, text = BOUNDS[kind.item]
        shown = text if number == "{}" else number.format(bound)

        def fits(value: float) -> bool:
            return not (value < -bound or value > bound) or math.isinf(value)

        return fits, f"a {kind.item} in [-{shown}, {shown}]"
    return (lambda value: True), ""


def _is_kept(kind: Type, field: str, value: Any) -> bool:
    """Whether a value already has the array type of the field; its element type and size are checked."""
    if kind.size and type(value).__name__ == "ndarray":
        dtype = DTYPES[kind.item]
        assert value.dtype == dtype, f"The '{field}' numpy.ndarray() must have the dtype of 'numpy.{dtype}'"
        assert value.size == kind.size, f"The '{field}' numpy.ndarray() must have a size of {kind.size}"
        return True
    if kind.sequence and isinstance(value, array):
        code = TYPECODES[kind.item]
        assert value.typecode == code, f"The '{field}' array.array() must have the type code of '{code}'"
        fits = not kind.bound or len(cast("array[Any]", value)) <= kind.bound
        assert fits, f"The '{field}' array.array() must have a size <= {kind.bound}"
        return True
    return False


def _many(kind: Type, owner: object, field: str, value: object) -> None:
    cls = _class(kind, owner)
    in_range, words = _range(kind, "{:f}")
    items: Any = value
    fits = (
        isinstance(value, (Sequence, Set))
        and not isinstance(value, str)
        and (not kind.limit or all(len(each) <= kind.limit for each in items))
        and (not kind.bound or len(items) <= kind.bound)
        and (not kind.size or len(items) == kind.size)
        and all(isinstance(each, cls) for each in items)
        and all(in_range(each) for each in items)
    )
    if fits:
        return
    parts = ["a set or sequence"]
    if kind.bound or kind.size:
        parts.append(f"with length <= {kind.bound}" if kind.bound else f"with length {kind.size}")
    if kind.limit:
        parts.append(f"and each string value not longer than {kind.limit}")
    parts.append(f"and each value of type '{cls.__name__}'")
    if words:
        parts.append(f"and each {words.partition(' ')[2]}")
    raise AssertionError(f"The '{field}' field must be {' '.join(parts)}")
