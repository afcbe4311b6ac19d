"""Messages as bytes and back: CDR version 1, as rmw implementations send it."""

from __future__ import annotations

import struct
from typing import Any

from bot_console.runtime.rosidl.cdr_read import CdrError, reader
from bot_console.runtime.rosidl.cdr_write import writer

HEADER = b"\x00\x01\x00\x00"
"""Plain CDR, little endian, no options."""
ORDERS = {0: ">", 1: "<"}
"""Byte orders by the second byte of the header."""


def serialize(message: Any) -> bytes:
    """The bytes of a message, header first; raises `FieldTypeError` where a field holds what cannot be sent."""
    # The copy is what a publish would send: fields checked, numbers of foreign types made plain.
    return serialize_copied(message._copy_())


def serialize_copied(message: Any) -> bytes:
    """The bytes of a message that is a copy, so well formed."""
    # The place of a number counts from behind the header of 4 bytes; with 4 more before it no offset is needed.
    out = bytearray(len(HEADER)) + HEADER
    writer(message.__class__)(message, out)
    del out[: len(HEADER)]  # moves nothing
    return bytes(out)


def deserialize(data: bytes | bytearray | memoryview, message_class: Any) -> Any:
    """The message that bytes are; raises `CdrError` where they are none of the class."""
    view = memoryview(data)
    if len(view) < len(HEADER) or view[0] != 0 or view[1] not in ORDERS:
        raise CdrError(f"no CDR header of version 1: {bytes(view[:4]).hex(' ') or 'no data'}")
    name = message_class.__name__
    try:
        return reader(message_class, ORDERS[view[1]])(view[len(HEADER) :], 0)[0]
    except struct.error:
        raise CdrError(f"{len(view)} bytes are too few for a {name}") from None
    except CdrError as error:
        raise CdrError(f"no {name}: {error}") from None
