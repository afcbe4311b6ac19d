"""Field checks with rclpy's words; on with `check_fields=True` or `ROS_PYTHON_CHECK_FIELDS=1`."""

from __future__ import annotations

import math
from array import array
from functools import lru_cache
from typing import Any

from bot_console.runtime.rosidl.definition import DTYPES, INTEGERS, TYPECODES, Type, parse_type
from bot_console.runtime.rosidl.emit_copy import LIMITS

SINGLE = 3.402823466e38
DOUBLE = 1.7976931348623157e308
cached_type = lru_cache(None)(parse_type)


def check(text: str, field: str, value: Any) -> None:
    """Raise `AssertionError` unless a value fits the type that `text` names."""
    kind = cached_type(text)
    if kind.size and kind.item in DTYPES:
        _fixed(kind, field, value)
    elif kind.sequence or kind.size:
        _many(kind, field, value)
    else:
        _one(kind, field, value)


def _one(kind: Type, field: str, value: Any) -> None:
    if not kind.primitive:
        name = kind.item.rpartition("/")[2]
        assert type(value).__name__ == name, f"The '{field}' field must be a sub message of type '{name}'"
    elif kind.item in INTEGERS:
        assert isinstance(value, int), f"The '{field}' field must be of type 'int'"
        low, high = LIMITS[kind.item]
        word = "an unsigned integer" if kind.item.startswith("u") else "an integer"
        assert low <= value <= high, f"The '{field}' field must be {word} in [{low}, {high}]"
    elif kind.item in ("float", "double"):
        assert isinstance(value, float), f"The '{field}' field must be of type 'float'"
        limit = SINGLE if kind.item == "float" else DOUBLE
        text = "3.402823466e+38" if kind.item == "float" else "1.7976931348623157e+308"
        fits = not (-limit > value or value > limit) or math.isinf(value)
        assert fits, f"The '{field}' field must be a float in [-{text}, {text}]"
    elif kind.item == "octet":
        fits = isinstance(value, (bytes, bytearray)) and len(value) == 1
        assert fits, f"The '{field}' field must be of type 'bytes' or 'ByteString' with length 1"
    else:
        name = "bool" if kind.item == "boolean" else "str"
        assert isinstance(value, bool if name == "bool" else str), f"The '{field}' field must be of type '{name}'"
        if kind.limit:
            assert len(value) <= kind.limit, f"The '{field}' field must be string value not longer than {kind.limit}"


def _fixed(kind: Type, field: str, value: Any) -> None:
    import numpy

    if isinstance(value, numpy.ndarray):
        dtype = DTYPES[kind.item]
        assert value.dtype == dtype, f"The '{field}' numpy.ndarray() must have the dtype of 'numpy.{dtype}'"
    size = getattr(value, "size", None) or len(value)
    assert size == kind.size, f"The '{field}' numpy.ndarray() must have a size of {kind.size}"


def _many(kind: Type, field: str, value: Any) -> None:
    if isinstance(value, array) and kind.item in TYPECODES:
        _bounded(kind, field, value)
        return
    if kind.item in TYPECODES:
        array(TYPECODES[kind.item], value)
        return
    word = "a set or sequence"
    sequence = isinstance(value, (list, tuple, set, bytes, bytearray)) and not isinstance(value, str)
    assert sequence, f"The '{field}' field must be {word} and each value of type '{_element(kind)}'"
    _bounded(kind, field, value)
    for each in value:
        _one(Type(kind.item, limit=kind.limit), field, bytes([each]) if isinstance(each, int) and isinstance(value, bytes) else each)  # fmt: skip


def _bounded(kind: Type, field: str, value: Any) -> None:
    if kind.bound:
        assert len(value) <= kind.bound, f"The '{field}' field must be a set or sequence with length <= {kind.bound}"
    if kind.size:
        assert len(value) == kind.size, f"The '{field}' field must be a set or sequence with length {kind.size}"


def _element(kind: Type) -> str:
    words = {"boolean": "bool", "octet": "bytes", "string": "str", "wstring": "str"}
    return words.get(kind.item, kind.item.rpartition("/")[2])
