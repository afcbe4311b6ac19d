"""Writes, for a message class, the function that returns the bytes of a message in one pass.

Adjacent numbers are packed by one call of `struct`, with the length of the text or sequence after them; for
`std_msgs/msg/String` the function is

    def f(m):
        v1 = m._data
        if v1.__class__ is not str: raise Inexact
        d2 = v1.encode()
        if 0 in d2: raise Inexact
        c3 = S1.pack(256, len(d2) + 1)
        return join((c3, d2, b'\\0'))
"""

from __future__ import annotations

import sys
from array import array
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from bot_console.runtime.rosidl.cdr_layout import ANYWHERE, CODES, FILLER, START, Part, parts, row
from bot_console.runtime.rosidl.cdr_source import Source
from bot_console.runtime.rosidl.definition import DTYPES, TYPECODES
from bot_console.runtime.rosidl.slot_types import nested_class

Put = Callable[[Any], None]

HEADER = "256"
"""The header as a number: plain CDR, little endian, no options (00 01 00 00)."""
EXACT = {"boolean": "bool", "float": "float", "double": "float"}
"""Python classes of numbers. For all other types, `struct` accepts and rejects the same values as the field."""
ZEROS = tuple(bytes(length) for length in range(8))
LENGTHS = row(["I"], ANYWHERE, "<")[0]


class InexactError(TypeError):
    """A field does not hold exactly what a copy of the message would hold."""


@cache
def writer(cls: Any) -> Callable[[Any], bytes]:
    """Return the function that serializes a message, with its header.

    The function raises some exception if a field does not hold exactly what a copy of the message would hold.
    """
    writing = _WriterGenerator(cls, outermost=True)
    return writing.source.compiled("m", writing.lines(), f"CDR writer of {cls.__name__}")


@cache
def element_writer(cls: Any) -> Callable[[Any, Put, int], int]:
    """Return the function `(message, put, at)` that writes a sequence element and returns the position after it."""
    writing = _WriterGenerator(cls, outermost=False)
    return writing.source.compiled("m, put, at", writing.lines(), f"CDR writer of {cls.__name__} in a sequence")


class _WriterGenerator:
    """Generates a writer; `_codes` and `_values` are the pending row of numbers."""

    def __init__(self, cls: object, *, outermost: bool) -> None:
        helpers = (array, is_octets, texts, wide)
        names = {"Inexact": InexactError, "join": b"".join, "ZEROS": ZEROS, **{each.__name__: each for each in helpers}}
        self.source = Source(names, "<", *((START, START.rest) if outermost else (ANYWHERE, None)))
        self._outermost = outermost
        self._listed = not outermost or any(not each.type.primitive for each in parts(cls))
        self._chunks: list[str] = []
        self._unchanged: list[str] = []
        self._codes: list[str] = []
        self._values: list[str] = []
        self._floats: list[str] = []
        if outermost:
            if self._listed:
                self.source.line("out = []")
                self.source.line("put = out.append")
            self._add("I", HEADER)
        else:
            self._want("m.__class__ is " + self.source.name("C", cls))
        for name, expression, inner in self.source.nested(cls):
            self.source.line(f"{name} = {expression}")
            self._want(f"{name}.__class__ is {self.source.name('C', inner)}")
        for part in parts(cls):
            self._part(part)
        self._end_row()

    def lines(self) -> Sequence[str]:
        """Return the body of the function."""
        line = self.source.line
        if not self._outermost:
            line(f"return {self.source.there}")
            return self.source.lines()
        joined = "out" if self._listed else f"({', '.join(self._chunks)})"
        line(f"data = join({joined})" if self._listed or len(self._chunks) > 1 else f"data = {self._chunks[0]}")
        # Another thread may have changed the length of an array meanwhile.
        for unchanged in self._unchanged:
            self._want(unchanged)
        line("return data")
        return self.source.lines()

    def _want(self, condition: str) -> None:
        self.source.line(f"if not ({condition}): raise Inexact")

    def _add(self, code: str, value: str = "") -> None:
        self._codes.append(code)
        if value:
            self._values.append(value)

    def _chunk(self, name: str) -> None:
        if self._listed:
            self.source.line(f"put({name})")
        else:
            self._chunks.append(name)

    def _end_row(self) -> None:
        """Emit the code that writes the pending numbers."""
        if self._floats:
            self._want(" and ".join(self._floats))
        codes, values = self._codes, self._values
        self._codes, self._values, self._floats = [], [], []
        if codes == ["x"]:
            self._chunk("ZEROS[1]")
            self.source.step(1)
        elif codes:
            name = self.source.local("c")
            self.source.row(codes, lambda structure: f"{name} = {structure}.pack({', '.join(values)})")
            self._chunk(name)

    def _part(self, part: Part) -> None:
        kind = part.type
        if part.number:
            self._number(part)
            return
        value = self.source.local("v")
        self.source.line(f"{value} = {self.source.field(part.path)}")
        if kind.size and kind.item in DTYPES:
            self._fixed(part, value)
        elif kind.size or kind.sequence:
            self._many(part, value)
        else:
            self._want(f"{value}.__class__ is str" + (f" and len({value}) <= {kind.limit}" if kind.limit else ""))
            self._text(kind.item, value)

    def _number(self, part: Part) -> None:
        code, value = CODES[part.type.item], "0" if part.path[-1] == FILLER else self.source.field(part.path)
        if part.type.item in EXACT:
            name = self.source.local("a")
            self.source.line(f"{name} = {value}")
            self._floats.append(f"{name}.__class__ is {EXACT[part.type.item]}")
            value = name
        self._add(code, value)

    def _text(self, item: str, value: str) -> None:
        data = self.source.local("d")
        if item == "wstring":
            self._computed(f"wide({value}, %s)")
            return
        self.source.line(f"{data} = {value}.encode()")
        self._want(f"0 not in {data}")
        self._add("I", f"len({data}) + 1")
        self._end_row()
        self._chunk(data)
        self.source.leap(f"len({data})", ANYWHERE)
        self._add("x")  # the terminating zero

    def _computed(self, call: str) -> None:
        """Emit bytes that depend on their position in the stream."""
        self._end_row()
        data = self.source.local("d")
        self.source.line(f"{data} = {call % self.source.there}")
        self._chunk(data)
        self.source.leap(f"len({data})", ANYWHERE)

    def _fixed(self, part: Part, value: str) -> None:
        """Emit numbers in a NumPy array."""
        import numpy

        dtype, size = numpy.dtype(DTYPES[part.type.item]), part.type.size
        array_class, wanted = self.source.name("C", numpy.ndarray), self.source.name("T", dtype)
        self._want(f"{value}.__class__ is {array_class} and {value}.dtype == {wanted} and {value}.shape == ({size},)")
        self._add(f"0{CODES[part.type.item]}")
        self._end_row()
        data = self.source.local("d")
        self.source.line(f"{data} = {value}{'.byteswap()' if sys.byteorder == 'big' else ''}.tobytes()")
        self._chunk(data)
        self.source.step(size * dtype.itemsize)

    def _many(self, part: Part, value: str) -> None:
        kind = part.type
        numbers = kind.item in TYPECODES
        wanted = f"{value}.__class__ is {'array' if numbers else 'list'}"
        if numbers:
            wanted += f" and {value}.typecode == {TYPECODES[kind.item]!r}"
        self._want(wanted)
        if numbers:
            self._numbers(part, value)
            return
        # Elements added meanwhile by another thread are not counted.
        self.source.line(f"{value} = [*{value}]")
        if kind.size or kind.bound:
            self._want(f"len({value}) {f'== {kind.size}' if kind.size else f'<= {kind.bound}'}")
        if kind.sequence:
            self._add("I", f"len({value})")
        self._end_row()
        if not kind.primitive:
            self._messages(part, value)
        elif kind.item in ("boolean", "octet"):
            octets = kind.item == "octet"
            self._want(f"is_octets({value})" if octets else f"{{*map(type, {value})}} <= {{bool}}")
            data = self.source.local("d")
            self.source.line(f"{data} = {'join' if octets else 'bytes'}({value})")
            self._chunk(data)
            self.source.leap(f"len({data})", ANYWHERE)
        else:
            self._computed(f"texts({value}, %s, {kind.limit}, {kind.item == 'wstring'})")

    def _numbers(self, part: Part, value: str) -> None:
        """Emit a sequence of numbers, aligned only if it has any."""
        code = TYPECODES[part.type.item]
        size, count = array(code).itemsize, self.source.local("n")
        self.source.line(f"{count} = len({value})")
        if part.type.bound:
            self._want(f"{count} <= {part.type.bound}")
        self._add("I", count)
        self._end_row()
        gap = self.source.place.gap(size)
        # After an empty sequence nothing needs alignment.
        behind = self.source.place.behind_many(size if gap == 0 else 4)
        if gap != 0:
            filler = self.source.local("g")
            length = f"-({self.source.aligned}) & {size - 1}" if gap is None else str(gap)
            self.source.line(f"{filler} = ZEROS[{length} if {count} else 0]")
            self._chunk(filler)
            self.source.leap(f"len({filler})", behind)
        data = value
        if sys.byteorder == "big" and size > 1:
            data = self.source.local("d")
            self.source.line(f"{data} = {value}[:]; {data}.byteswap()")
        elif self._outermost:
            self._unchanged.append(f"len({value}) == {count}")
        else:
            data = self.source.local("d")
            self.source.line(f"{data} = {value}.tobytes()")
            self._want(f"len({data}) == {count} * {size}")
        self._chunk(data)
        self.source.leap(f"{count} * {size}", behind)

    def _messages(self, part: Part, value: str) -> None:
        self.source.reach()
        write = self.source.name("W", element_writer(nested_class(part.owner, part.type.item)))
        self.source.line(f"for each in {value}:")
        self.source.line(f"    at = {write}(each, put, at)")
        self.source.land(ANYWHERE)


def is_octets(values: Sequence[Any]) -> bool:
    """Whether each element is a single byte."""
    return all(isinstance(each, bytes) and len(each) == 1 for each in values)


def texts(values: Sequence[object], at: int, limit: int, is_wide: bool) -> bytes:
    """Return the bytes of strings at a position, each with at most `limit` characters (0 means any length)."""
    chunks: list[bytes] = []
    for value in values:
        if not isinstance(value, str) or (limit and len(value) > limit):
            raise InexactError
        data = wide(value, at) if is_wide else _text(value, at)
        chunks.append(data)
        at += len(data)
    return b"".join(chunks)


def _text(value: str, at: int) -> bytes:
    data = value.encode()
    if 0 in data:
        raise InexactError
    return b"%b%b\0" % (LENGTHS[at & 7].pack(len(data) + 1), data)


def wide(value: str, at: int) -> bytes:
    """Return a wide string: its number of UTF-16 units, then each unit in four bytes, as all ROS 2 middlewares do."""
    if "\0" in value:
        raise InexactError
    units = array("H", value.encode(f"utf-16-{sys.byteorder[0]}e"))
    words = array("I", units)
    if sys.byteorder == "big":
        words.byteswap()
    return LENGTHS[at & 7].pack(len(words)) + words.tobytes()
