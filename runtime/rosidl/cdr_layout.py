"""The layout of a message in CDR: runs of numbers between the parts whose length is known only when they are read."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from bot_console.runtime.rosidl.definition import TYPECODES, Type, parse_type
from bot_console.runtime.rosidl.slot_types import nested_class

CODES = {"boolean": "?", "octet": "c", **TYPECODES}
"""Codes of `struct` by element type; for numbers they are those of `array.array`."""

FILLER = ""
"""Name of the byte sent for a structure without fields."""


class Part(NamedTuple):
    """A field, given by its path from the outermost message; `owner` is the class that declares it."""

    path: tuple[str, ...]
    type: Type
    owner: Any

    @property
    def number(self) -> bool:
        """Whether it is a value of known length and not an array."""
        return self.type.item in CODES and not self.type.sequence and not self.type.size


def parts(cls: Any, path: tuple[str, ...] = ()) -> Iterator[Part]:
    """Yield a message class's fields in wire order; nested messages are replaced by their fields."""
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
    """Yield the single nested messages with their paths, outer ones first."""
    for name, text in cls._fields_and_field_types.items():
        kind = parse_type(text)
        if not (kind.primitive or kind.sequence or kind.size):
            inner = nested_class(cls, kind.item)
            yield (*path, name), inner
            yield from nested(inner, (*path, name))


class Place(NamedTuple):
    """The statically known part of a position in the stream: its remainder `rest` modulo `step`, a power of two."""

    step: int
    rest: int

    def gap(self, size: int) -> int | None:
        """Return the padding to the next multiple of `size`; None if it depends on the stream."""
        return -self.rest % size if size <= self.step else None

    def behind(self, length: int) -> Place:
        """Return the place that is `length` bytes further on."""
        return Place(self.step, (self.rest + length) % self.step)

    def behind_many(self, size: int) -> Place:
        """Return the place after an unknown number of elements of `size` bytes."""
        step = min(self.step, size)
        return Place(step, self.rest % step)


START = Place(8, 4)
"""The place after the 4 bytes of the header, from which alignment to 8 is counted."""
ANYWHERE = Place(1, 0)


def row(codes: Sequence[str], place: Place, order: str) -> tuple[Sequence[struct.Struct], Place]:
    """Return the structures for a row of numbers that begins at a place, and the place after them.

    It is one structure if the place determines all padding between the numbers, otherwise eight, one for each place
    modulo 8. Codes are those of `struct`, with an optional count: `0d` only aligns, `x` is an unused byte.
    """
    behind, known = place, True
    for code in codes:
        size, length = struct.calcsize(order + code[-1]), struct.calcsize(order + code)
        gap = behind.gap(size)
        known = known and gap is not None
        behind = Place(size, 0).behind(length) if gap is None else behind.behind(gap + length)
    starts = (place.rest,) if known else range(8)
    return [struct.Struct(order + _with_padding(codes, start, order)) for start in starts], behind


def _with_padding(codes: Sequence[str], start: int, order: str) -> str:
    text = ""
    for code in codes:
        gap = -start % struct.calcsize(order + code[-1])
        text += "x" * gap + code
        start += gap + struct.calcsize(order + code)
    return text
