"""Messages of any class with arbitrary values, also in the form that rosbags serializes."""

from __future__ import annotations

import math
from array import array
from types import SimpleNamespace
from typing import Any

import numpy
import pytest
from bot_console.runtime.rosidl.definition import DTYPES, TYPECODES, Type, parse_type
from bot_console.runtime.rosidl.emit_copy import LIMITS
from bot_console.runtime.rosidl.slot_types import nested_class
from hypothesis import strategies as st

TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=12)
MAX_LENGTH = 5


def _single(kind: Type) -> st.SearchStrategy[Any]:
    if kind.item in LIMITS:
        return st.integers(*LIMITS[kind.item])
    if kind.item in ("float", "double"):
        return st.floats(width=32 if kind.item == "float" else 64)
    if kind.item == "boolean":
        return st.booleans()
    if kind.item == "octet":
        return st.binary(min_size=1, max_size=1)
    return TEXT


def _value(kind: Type, owner: Any) -> st.SearchStrategy[Any]:
    item = _single(kind) if kind.primitive else message_of(nested_class(owner, kind.item))
    if kind.size:
        return st.lists(item, min_size=kind.size, max_size=kind.size)
    return st.lists(item, max_size=kind.bound or MAX_LENGTH) if kind.sequence else item


def message_of(cls: Any) -> st.SearchStrategy[Any]:
    """Messages of a class."""
    fields = {name: _value(parse_type(text), cls) for name, text in cls._fields_and_field_types.items()}
    return st.builds(cls, **fields)


def are_equal(one: Any, other: Any) -> bool:
    """Whether two messages have the same values; NaN equals NaN, and arrays are compared as a whole."""
    if hasattr(one, "get_fields_and_field_types"):
        names = one.get_fields_and_field_types()
        return type(one) is type(other) and all(are_equal(getattr(one, each), getattr(other, each)) for each in names)
    if isinstance(one, (list, array, numpy.ndarray)):
        return type(one) is type(other) and len(one) == len(other) and all(map(are_equal, one, other))
    return one == other or (isinstance(one, float) and math.isnan(one) and math.isnan(other))


def to_rosbags(message: Any) -> Any:
    """A message as rosbags' serializer expects it: numbers in NumPy arrays, bytes as numbers."""
    found = SimpleNamespace(structure_needs_at_least_one_member=0)
    for name, text in message.get_fields_and_field_types().items():
        setattr(found, name, _to_rosbags(getattr(message, name), parse_type(text)))
    return found


def _to_rosbags(value: Any, kind: Type) -> Any:
    many = kind.sequence or kind.size
    if not kind.primitive:
        return [to_rosbags(each) for each in value] if many else to_rosbags(value)
    if not many:
        # rosbags packs a single byte as a signed number.
        return int.from_bytes(value, "little", signed=True) if kind.item == "octet" else value
    if kind.item in TYPECODES:
        return numpy.array(value, DTYPES[kind.item])
    if kind.item == "boolean":
        return numpy.array(value, bool)
    return numpy.array([each[0] for each in value], numpy.uint8) if kind.item == "octet" else value


@pytest.fixture(scope="session")
def messages() -> SimpleNamespace:
    return SimpleNamespace(of=message_of, same=are_equal, for_rosbags=to_rosbags)
