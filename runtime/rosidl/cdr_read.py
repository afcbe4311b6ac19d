"""Writes, for a message class, the function that reads a message from a CDR stream."""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

from bot_console.runtime.rosidl.cdr_layout import CODES, FILLER, Part, aligned, compiled, nested, runs
from bot_console.runtime.rosidl.definition import DTYPES, TYPECODES
from bot_console.runtime.rosidl.slot_types import nested_class


class CdrError(ValueError):
    """Bytes that are no message of the class asked for."""


@cache
def reader(cls: Any, order: str = "<") -> Callable[[memoryview, int], tuple[Any, int]]:
    """The function `(data, place)` that gives a message and the place behind it; raises `CdrError`."""
    names: dict[str, Any] = {
        "cls": cls,
        "new": object.__new__,
        "count": _counter(order),
        "text": read_text,
        "wide": read_wide,
        "numbers": read_numbers,
        "fixed": read_fixed,
        "octets": read_octets,
        "flags": read_flags,
    }
    lines = ["def f(data, at):", "    m = new(cls)", "    m._check_fields = False"]
    for path, inner in nested(cls):
        name = f"C{len(names)}"
        names[name] = inner
        target = _target(path)
        lines += [f"    {target} = new({name})", f"    {target}._check_fields = False"]
    for group in runs(cls):
        lines += ["    " + line for line in _group(group, names, order)]
    lines.append("    return m, at")
    return compiled("\n".join(lines), names, f"CDR reader of {cls.__name__}")


def _target(path: Sequence[str]) -> str:
    return "m" + "".join(f"._{name}" for name in path)


def _group(group: Sequence[Part], names: dict[str, Any], order: str) -> Iterator[str]:
    first = group[0]
    if first.number:
        name = f"S{len(names)}"
        names[name] = aligned("".join(CODES[each.type.item] for each in group), order)
        targets = ", ".join("_" if each.path[-1] == FILLER else _target(each.path) for each in group)
        yield f"s = {name}[at & 7]"
        yield f"{targets}, = s.unpack_from(data, at)"
        yield "at += s.size"
    elif first.type.sequence or first.type.size:
        yield from _many(first, names, order)
    else:
        yield "n, at = count(data, at)"
        yield f"{_target(first.path)}, at = {_single(first)}(data, at, n, {order!r})"


def _single(part: Part) -> str:
    return "wide" if part.type.item == "wstring" else "text"


def _many(part: Part, names: dict[str, Any], order: str) -> Iterator[str]:
    kind, target = part.type, _target(part.path)
    yield "n, at = count(data, at)" if kind.sequence else f"n = {kind.size}"
    if kind.item in TYPECODES:
        read = f"fixed(data, at, n, {DTYPES[kind.item]!r}" if kind.size else (
            f"numbers(data, at, n, {TYPECODES[kind.item]!r}")  # fmt: skip
        yield f"{target}, at = {read}, {order!r})"
    elif kind.item in ("octet", "boolean"):
        yield f"{target}, at = {'octets' if kind.item == 'octet' else 'flags'}(data, at, n)"
    elif kind.primitive:
        yield f"{target} = v = []"
        yield "for _ in range(n):"
        yield "    k, at = count(data, at)"
        yield f"    each, at = {_single(part)}(data, at, k, {order!r})"
        yield "    v.append(each)"
    else:
        name = f"R{len(names)}"
        names[name] = reader(nested_class(part.owner, kind.item), order)
        yield f"{target} = v = []"
        yield "for _ in range(n):"
        yield f"    each, at = {name}(data, at)"
        yield "    v.append(each)"


def _counter(order: str) -> Callable[[memoryview, int], tuple[int, int]]:
    structures = aligned("I", order)

    def count(data: memoryview, at: int) -> tuple[int, int]:
        structure = structures[at & 7]
        (number,) = structure.unpack_from(data, at)
        at += structure.size
        # Each element takes a byte at least, so a larger number is no number of elements.
        if number > len(data) - at:
            raise CdrError(f"{number} elements cannot be in the {len(data) - at} bytes that are left")
        return number, at

    return count


def _taken(data: memoryview, at: int, length: int) -> memoryview:
    if at + length > len(data):
        raise CdrError(f"{length} bytes are missing at byte {at}: the data end there")
    return data[at : at + length]


def read_text(data: memoryview, at: int, length: int, order: str) -> tuple[str, int]:
    """A string of `length` bytes, its closing zero among them."""
    raw = bytes(_taken(data, at, length))
    try:
        return (raw[:-1] if raw[-1:] == b"\0" else raw).decode(), at + length
    except UnicodeDecodeError as error:
        raise CdrError(f"a string at byte {at} is not UTF-8: {error}") from None


def read_wide(data: memoryview, at: int, length: int, order: str) -> tuple[str, int]:
    """A wide string of `length` UTF-16 units."""
    units, at = read_numbers(data, at, length, "I", order)
    try:
        return array("H", units).tobytes().decode(f"utf-16-{sys.byteorder[0]}e"), at
    except (UnicodeDecodeError, OverflowError) as error:
        raise CdrError(f"a wide string before byte {at} is not UTF-16: {error}") from None


def read_numbers(data: memoryview, at: int, length: int, code: str, order: str) -> tuple[array[Any], int]:
    """Numbers as an `array.array`."""
    values = array(code)
    if not length:
        return values, at
    at += -at % values.itemsize
    end = at + length * values.itemsize
    values.frombytes(_taken(data, at, end - at))
    if (order == "<") != (sys.byteorder == "little"):
        values.byteswap()
    return values, end


def read_fixed(data: memoryview, at: int, length: int, dtype: str, order: str) -> tuple[Any, int]:
    """Numbers as a NumPy array."""
    import numpy

    wire = numpy.dtype(dtype).newbyteorder(order)  # type: ignore[arg-type] -- one of two letters
    at += -at % wire.itemsize
    end = at + length * wire.itemsize
    return numpy.frombuffer(_taken(data, at, end - at), wire).astype(dtype), end


def read_octets(data: memoryview, at: int, length: int) -> tuple[list[bytes], int]:
    """Bytes, each on its own."""
    return [bytes([each]) for each in _taken(data, at, length)], at + length


def read_flags(data: memoryview, at: int, length: int) -> tuple[list[bool], int]:
    """Booleans."""
    return [bool(each) for each in _taken(data, at, length)], at + length
