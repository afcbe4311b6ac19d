"""Serialization of messages: CDR version 1, as rmw implementations send it.

The generators of the functions are imported with the first message, as many short-lived programs serialize none.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import cache
from typing import Any

from bot_console.runtime.rosidl.cdr_header import HEADER_SIZE, ORDERS, CdrError

__all__ = ["CdrError", "deserialize", "serialize"]


def serialize(message: Any) -> bytes:
    """Serialize a message, including the header; raises `FieldTypeError` if a field's value cannot be sent."""
    try:
        return _writer(message.__class__)(message)
    except Exception:  # any error: copying raises it for values that cannot be sent, and converts the others
        pass
    copy = message._copy_()
    return _writer(copy.__class__)(copy)


def deserialize(data: bytes | bytearray | memoryview, message_class: Any) -> Any:
    """Deserialize a message; raises `CdrError` if the bytes are not a message of the class."""
    if not isinstance(data, bytes):
        data = bytes(data)
    if len(data) < HEADER_SIZE or data[0] != 0 or data[1] not in ORDERS:
        raise CdrError(f"no CDR header of version 1: {data[:HEADER_SIZE].hex(' ') or 'no data'}")
    try:
        return _reader(message_class, ORDERS[data[1]])(data)
    except struct.error:
        raise CdrError(f"{len(data)} bytes are too few for a {message_class.__name__}") from None
    except CdrError as error:
        raise CdrError(f"no {message_class.__name__}: {error}") from None


@cache
def _writer(cls: Any) -> Callable[[Any], bytes]:
    if hasattr(cls, "_given_digest"):  # a class without fields, from `generic.py`
        return cls._to_bytes
    from bot_console.runtime.rosidl.cdr_write import writer

    return writer(cls)


@cache
def _reader(cls: Any, order: str) -> Callable[[bytes], Any]:
    if hasattr(cls, "_given_digest"):
        return cls
    from bot_console.runtime.rosidl.cdr_read import reader

    return reader(cls, order)
