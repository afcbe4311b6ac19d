"""The 33 bytes that go with each message, request and response: its number, its time, and whose it is."""

from __future__ import annotations

import struct

from bot_console.runtime.rmw.zenoh.wire.keys import FormatError

GID_SIZE = 16
_LAYOUT = struct.Struct("<qqB16s")
_FIELDS = struct.Struct("<qqx16s")
"""The same without the length of the id."""
_OLD = b"\x0fsequence_number"

Attachment = tuple[int, int, bytes]
"""Number (from 1 on per publisher or client), time of sending (ns since 1970), and the sender's id."""


def gid_of(token: str) -> bytes:
    """The id of an entity: a hash of its liveliness token."""
    from xxhash import xxh3_128_intdigest

    return xxh3_128_intdigest(token.encode()).to_bytes(GID_SIZE, "little")


def pack(number: int, time_ns: int, gid: bytes) -> bytes:
    """The bytes."""
    return _LAYOUT.pack(number, time_ns, GID_SIZE, gid)


def unpack(data: bytes | None) -> Attachment:
    """What the bytes say; raises `FormatError`, which names the releases that wrote them otherwise."""
    if data is None:
        raise FormatError("a message without attachment: its sender does not speak the format of rmw_zenoh")
    if len(data) != _LAYOUT.size or data[16] != GID_SIZE:
        if data.startswith(_OLD):
            raise FormatError("the sender's rmw_zenoh is too old (before Jazzy 0.2.4, Humble 0.1.2): update it")
        raise FormatError(f"no attachment of 33 bytes: {data[:40].hex(' ')}")
    return _FIELDS.unpack(data)
