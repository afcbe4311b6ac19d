"""Writes, for a message class, the function that appends a message to a CDR stream."""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

from bot_console.runtime.rosidl.cdr_layout import CODES, FILLER, Part, aligned, compiled, runs
from bot_console.runtime.rosidl.definition import DTYPES, TYPECODES
from bot_console.runtime.rosidl.slot_types import nested_class

COUNT = aligned("I", "<")


@cache
def writer(cls: Any) -> Callable[[Any, bytearray], None]:
    """The function `(message, out)`; the fields must hold what their types say, as in a copy made by `_copy_`."""
    names: dict[str, Any] = {
        "text": write_text,
        "wide": write_wide,
        "numbers": write_numbers,
        "COUNT": COUNT,
    }
    lines = ["def f(m, out):", "    pass"]
    for group in runs(cls):
        lines += ["    " + line for line in _group(group, names)]
    return compiled("\n".join(lines), names, f"CDR writer of {cls.__name__}")


def _value(part: Part) -> str:
    return "0" if part.path[-1] == FILLER else "m" + "".join(f"._{name}" for name in part.path)


def _group(group: Sequence[Part], names: dict[str, Any]) -> Iterator[str]:
    first = group[0]
    if first.number:
        name = f"S{len(names)}"
        names[name] = aligned("".join(CODES[each.type.item] for each in group), "<")
        yield f"out += {name}[len(out) & 7].pack({', '.join(map(_value, group))})"
    elif first.type.sequence or first.type.size:
        yield from _many(first, names)
    else:
        yield f"{_single(first)}({_value(first)}, out)"


def _single(part: Part) -> str:
    return "wide" if part.type.item == "wstring" else "text"


def _many(part: Part, names: dict[str, Any]) -> Iterator[str]:
    kind = part.type
    yield f"v = {_value(part)}"
    if kind.sequence:
        yield "out += COUNT[len(out) & 7].pack(len(v))"
    if kind.item in TYPECODES:
        code = DTYPES[kind.item] if kind.size else TYPECODES[kind.item]
        yield f"numbers(v, {code!r}, out)"
    elif kind.item == "octet":
        yield "out += b''.join(v)"
    elif kind.item == "boolean":
        yield "out += bytes(v)"
    elif kind.primitive:
        yield "for each in v:"
        yield f"    {_single(part)}(each, out)"
    else:
        name = f"W{len(names)}"
        names[name] = writer(nested_class(part.owner, kind.item))
        yield "for each in v:"
        yield f"    {name}(each, out)"


def write_text(value: str, out: bytearray) -> None:
    """A string: its length in bytes with the closing zero, then these."""
    data = value.partition("\0")[0].encode()
    out += COUNT[len(out) & 7].pack(len(data) + 1)
    out += data
    out.append(0)


def write_wide(value: str, out: bytearray) -> None:
    """A wide string: its number of UTF-16 units, then each in four bytes, as ROS 2's middlewares agree."""
    units = array("H", value.partition("\0")[0].encode("utf-16-le"))
    if sys.byteorder == "big":
        units.byteswap()
    out += COUNT[len(out) & 7].pack(len(units))
    write_numbers(array("I", units), "I", out)


def write_numbers(values: Any, code: str, out: bytearray) -> None:
    """The numbers of an `array.array` or a NumPy array, aligned to their size."""
    size = values.itemsize
    if len(values):
        out += bytes(-len(out) % size)
    if sys.byteorder == "big" and size > 1:
        values = values.byteswap() if hasattr(values, "dtype") else _swapped(values)
    out += memoryview(values)


def _swapped(values: array[Any]) -> array[Any]:
    copy = values[:]
    copy.byteswap()
    return copy
