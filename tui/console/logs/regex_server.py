"""The program that searches with Python's own `re`, for `regex_process`. Standard library only; ends with its input.

A request consists of three blocks, a response of one; a block is its length (4 bytes) and that many bytes.
"""

from __future__ import annotations

import array
import re
import struct
import sys
from collections.abc import Sequence
from typing import BinaryIO

GOOD, BAD = b"+", b"-"


def block(data: bytes) -> bytes:
    """Bytes, prefixed with their length."""
    return struct.pack("<I", len(data)) + data


def request(pattern: bytes, blob: bytes, ends: Sequence[int]) -> bytes:
    """A pattern, and the texts to search in a blob; `ends` are the positions after their newlines."""
    return block(pattern) + block(blob) + block(array.array("q", ends).tobytes())


def answer(pattern: bytes, blob: bytes, ends: Sequence[int]) -> bytes:
    """One byte per text, 1 if the pattern matches; or the error message of `re`."""
    try:
        search = re.compile(pattern.decode()).search
    except (re.error, OverflowError, RecursionError) as error:
        return BAD + str(error).encode("utf-8", "replace")
    found = bytearray()
    begin = 0
    for end in ends:
        found.append(search(blob[begin : end - 1].decode("utf-8", "replace")) is not None)
        begin = end
    return GOOD + bytes(found)


def _read(file: BinaryIO) -> bytes:
    head = file.read(4)
    size = struct.unpack("<I", head)[0] if len(head) == 4 else 0
    data = file.read(size)
    if len(head) < 4 or len(data) < size:
        sys.exit(0)
    return data


def main() -> None:
    """Serve requests until the input ends."""
    source, sink = sys.stdin.buffer, sys.stdout.buffer
    sink.write(block(b"ready"))
    sink.flush()
    while True:
        pattern, blob, ends = _read(source), _read(source), array.array("q")
        ends.frombytes(_read(source))
        sink.write(block(answer(pattern, blob, ends)))
        sink.flush()


if __name__ == "__main__":
    main()
