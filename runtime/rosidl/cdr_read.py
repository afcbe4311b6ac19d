"""Writes, for a message class, the function that reads a message from its bytes.

For `std_msgs/msg/String` it is

    def f(data):
        end = len(data)
        m = new(C1)
        m._check_fields = False
        n1, = S2.unpack_from(data, 4)
        at = 8
        if n1 > end - at: raise too_many(n1, end - at)
        raw = data[at:at + n1 - 1] if n1 and not data[at + n1 - 1] else data[at:at + n1]
        m._data = raw.decode("utf-8", "replace")
        return m

As in rclpy, bytes of a string that are not UTF-8 are replaced, so that a stop or a log record is not lost because of
its text.
"""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from bot_console.runtime.rosidl.cdr_header import HEADER_SIZE, CdrError
from bot_console.runtime.rosidl.cdr_layout import ANYWHERE, CODES, FILLER, START, Part, Place, parts, row
from bot_console.runtime.rosidl.cdr_source import Source
from bot_console.runtime.rosidl.definition import TYPECODES
from bot_console.runtime.rosidl.slot_types import nested_class

LENGTHS = {order: row(["I"], ANYWHERE, order)[0] for order in "<>"}


@cache
def reader(cls: Any, order: str = "<") -> Callable[[bytes], Any]:
    """Return the function that reads a message of a class; raises `CdrError`, or `struct.error` for missing bytes."""
    reading = _ReaderGenerator(cls, order, outermost=True)
    return reading.source.compiled("data", reading.lines(), f"CDR reader of {cls.__name__}")


@cache
def element_reader(cls: Any, order: str) -> Callable[[bytes, memoryview, int, int], tuple[Any, int]]:
    """Return the function `(data, view, at, end)` for an element of a sequence: it returns the element and the position
    after it.
    """
    reading = _ReaderGenerator(cls, order, outermost=False)
    return reading.source.compiled(
        "data, view, at, end", reading.lines(), f"CDR reader of {cls.__name__} in a sequence"
    )


class _ReaderGenerator:
    """Generates a reader; `_codes` and `_targets` are the pending row of numbers."""

    def __init__(self, cls: object, order: str, *, outermost: bool) -> None:
        helpers = (fixed, flags, missing, octets, texts, too_many, wide)
        names = {"array": array, "new": object.__new__, **{each.__name__: each for each in helpers}}
        begin = (START.behind(HEADER_SIZE), HEADER_SIZE) if outermost else (ANYWHERE, None)
        self.source = Source(names, order, *begin, shift=START.rest)
        self._order = order
        self._outermost = outermost
        self._codes: list[str] = []
        self._targets: list[str] = []
        every = list(parts(cls))
        if outermost and any(not each.number for each in every):
            self.source.line("end = len(data)")
        if outermost and any(each.type.sequence or not each.type.primitive for each in every):
            self.source.line("view = memoryview(data)")
        self._messages_made(cls)
        for part in every:
            self._part(part)
        self._end_row()

    def _messages_made(self, cls: object) -> None:
        line = self.source.line
        line(f"m = new({self.source.name('C', cls)})")
        line("m._check_fields = False")
        for name, expression, inner in self.source.nested(cls):
            line(f"{expression} = {name} = new({self.source.name('C', inner)})")
            line(f"{name}._check_fields = False")

    def lines(self) -> Sequence[str]:
        """Return the body of the function."""
        self.source.line("return m" if self._outermost else f"return m, {self.source.there}")
        return self.source.lines()

    def _end_row(self) -> None:
        """Emit the code that reads the pending numbers."""
        codes, targets = self._codes, self._targets
        self._codes, self._targets = [], []
        if codes:
            there = self.source.there
            self.source.row(codes, lambda structure: f"{', '.join(targets)}, = {structure}.unpack_from(data, {there})")

    def _part(self, part: Part) -> None:
        kind, target = part.type, "_" if part.path[-1] == FILLER else self.source.field(part.path)
        if part.number:
            self._codes.append(CODES[kind.item])
            self._targets.append(target)
            return
        count = str(kind.size)
        if not kind.size:
            count = self.source.local("n")
            self._codes.append("I")
            self._targets.append(count)
        self._end_row()
        if not kind.size:
            self.source.reach()
            # Each element takes at least one byte, so a larger number cannot be a valid length.
            self.source.line(f"if {count} > end - at: raise too_many({count}, end - at)")
        if not kind.sequence and not kind.size:
            self._text(kind.item, target, count)
        elif kind.item in TYPECODES:
            (self._fixed if kind.size else self._numbers)(kind.item, target, count)
        elif kind.primitive:
            self.source.reach()
            read = {"octet": "octets(", "boolean": "flags("}.get(
                kind.item, f"texts({self._order!r}, {kind.item == 'wstring'}, "
            )
            self.source.line(f"{target}, at = {read}data, at, {count}, end)")
            self.source.land(ANYWHERE)
        else:
            self._messages(part, target, count)

    def _text(self, item: str, target: str, count: str) -> None:
        if item == "wstring":
            self.source.line(f"{target}, at = wide({self._order!r}, data, at, {count}, end)")
            self.source.land(ANYWHERE)
            return
        last = f"at + {count} - 1"
        self.source.line(f"raw = data[at:{last}] if {count} and not data[{last}] else data[at:at + {count}]")
        self.source.line(f'{target} = raw.decode("utf-8", "replace")')
        self.source.leap(count, ANYWHERE)

    def _numbers(self, item: str, target: str, count: str) -> None:
        """Emit a sequence of numbers, aligned only if it has any."""
        source, code = self.source, TYPECODES[item]
        size, values = array(code).itemsize, source.local("v")
        gap = source.place.gap(size)
        source.line(f"{target} = {values} = array({code!r})")
        source.line(f"if {count}:")
        if gap != 0:
            source.line(f"    at += {f'-({source.aligned}) & {size - 1}' if gap is None else gap}")
        source.line(f"    stop = at + {count} * {size}")
        source.line("    if stop > end: raise missing(at, stop)")
        source.line(f"    {values}.frombytes(view[at:stop])")
        if (self._order == "<") != (sys.byteorder == "little"):
            source.line(f"    {values}.byteswap()")
        source.line("    at = stop", moves=True)
        source.land(source.place.behind_many(size if gap == 0 else 4))

    def _fixed(self, item: str, target: str, count: str) -> None:
        """Emit numbers in a NumPy array."""
        source, code = self.source, CODES[item]
        size = row([code], ANYWHERE, "=")[0][0].size
        gap = source.place.gap(size)
        if gap is None:
            source.leap(f"(-({source.aligned}) & {size - 1})", Place(size, 0))
        else:
            source.step(gap)
        source.reach()
        source.line(f"{target} = fixed(data, at, {count}, {self._order + code!r}, end)")
        source.step(int(count) * size)

    def _messages(self, part: Part, target: str, count: str) -> None:
        self.source.reach()
        read = self.source.name("R", element_reader(nested_class(part.owner, part.type.item), self._order))
        values = self.source.local("v")
        self.source.line(f"{target} = {values} = []")
        self.source.line(f"for _ in range({count}):")
        self.source.line(f"    each, at = {read}(data, view, at, end)")
        self.source.line(f"    {values}.append(each)")
        self.source.land(ANYWHERE)


def too_many(count: int, left: int) -> CdrError:
    """Return the error for an impossible length."""
    return CdrError(f"{count} elements cannot be in the {left} bytes that are left")


def missing(at: int, stop: int) -> CdrError:
    """Return the error for bytes that end in the middle of an array."""
    return CdrError(f"{stop - at} bytes are missing at byte {at - HEADER_SIZE}: the data end there")


def texts(order: str, is_wide: bool, data: bytes, at: int, length: int, end: int) -> tuple[list[str], int]:
    """Read strings."""
    lengths, found = LENGTHS[order], list[str]()
    for _ in range(length):
        structure = lengths[(at + START.rest) & 7]
        (count,) = structure.unpack_from(data, at)
        at += structure.size
        if count > end - at:
            raise too_many(count, end - at)
        if is_wide:
            text, at = wide(order, data, at, count, end)
        else:
            raw = data[at : at + count]
            text = (raw[:-1] if raw[-1:] == b"\0" else raw).decode("utf-8", "replace")
            at += count
        found.append(text)
    return found, at


def wide(order: str, data: bytes, at: int, length: int, end: int) -> tuple[str, int]:
    """Read a wide string of `length` UTF-16 units, each in four bytes."""
    stop = at + 4 * length
    if stop > end:
        raise missing(at, stop)
    units = array("I", data[at:stop])
    if (order == "<") != (sys.byteorder == "little"):
        units.byteswap()
    try:
        return array("H", units).tobytes().decode(f"utf-16-{sys.byteorder[0]}e"), stop
    except (UnicodeDecodeError, OverflowError) as error:
        raise CdrError(f"a wide string before byte {stop - HEADER_SIZE} is not UTF-16: {error}") from None


def fixed(data: bytes, at: int, length: int, wire: str, end: int) -> Any:
    """Read numbers into a NumPy array."""
    import numpy

    dtype = numpy.dtype(wire)
    if at + length * dtype.itemsize > end:
        raise missing(at, at + length * dtype.itemsize)
    # Chosen by size, not by code: to NumPy's `repr`, an array with the code q is not an int64.
    return numpy.frombuffer(data, dtype, length, at).astype(f"{dtype.kind}{dtype.itemsize}")


def octets(data: bytes, at: int, length: int, end: int) -> tuple[list[bytes], int]:
    """Read single bytes."""
    if at + length > end:
        raise missing(at, at + length)
    return [bytes([each]) for each in data[at : at + length]], at + length


def flags(data: bytes, at: int, length: int, end: int) -> tuple[list[bool], int]:
    """Read booleans."""
    if at + length > end:
        raise missing(at, at + length)
    return [each != 0 for each in data[at : at + length]], at + length
