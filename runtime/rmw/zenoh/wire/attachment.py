"""The attachment of each message, request and response: number, time and sender, in rmw_zenoh's 33 bytes.

Ours end with a seal, a hash of the payload, which rmw_zenoh ignores. When Zenoh cuts the link to a process that does
not read, it stops in the middle of a message but still writes what is queued behind it: the rest of that message then
consists of foreign bytes, which would be taken for the end of a command or a parameter.
"""

from __future__ import annotations

import struct

from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from xxhash import xxh3_64_intdigest, xxh3_128_intdigest

GID_BYTES = 16
_LAYOUT = struct.Struct("<qqB16s")
_FIELDS = struct.Struct("<qqx16s")
"""The same layout, skipping the byte that holds the length of the id."""
_SEALED_LAYOUT = struct.Struct("<qqB16s4sQ")
_SEAL = b"xxh3"
_SEALED_SIZE = _SEALED_LAYOUT.size
SEALED = 1 << 16
"""How many bytes at a payload's end are hashed: a link writes at most that much at once, and a cut corrupts no more of
one message. If a longer message is cut in a fragment before its last, the next fragment is missing, too, unless the
foreign bytes happen to end with the fragment; Zenoh drops such a message by its fragment numbers.
"""
_OLD = b"\x0fsequence_number"

Attachment = tuple[int, int, bytes]
"""Number (counted from 1 per publisher or client), time of sending (ns since 1970), and the sender's id."""


def gid_of(token: str) -> bytes:
    """Return an entity's id: a hash of its liveliness token."""
    return xxh3_128_intdigest(token.encode()).to_bytes(GID_BYTES, "little")


def pack(number: int, time_ns: int, gid: bytes, payload: bytes | None = None) -> bytes:
    """Return the attachment as bytes; sealed if a payload is given."""
    if payload is None:
        return _LAYOUT.pack(number, time_ns, GID_BYTES, gid)
    return _SEALED_LAYOUT.pack(number, time_ns, GID_BYTES, gid, _SEAL, _hash(payload))


def unpack(data: bytes | None, payload: bytes | None = None) -> Attachment:
    """Parse an attachment.

    Raises `FormatError` if the layout is different, with the rmw_zenoh releases known to write another one, or if it is
    sealed and `payload` is not what was sent.
    """
    if data is None:
        raise FormatError("a message without attachment: its sender does not speak the format of rmw_zenoh")
    size = len(data)
    if size == _SEALED_SIZE:
        number, time_ns, gid_size, gid, mark, seal = _SEALED_LAYOUT.unpack(data)
        if gid_size == GID_BYTES and mark == _SEAL:
            if payload is not None and seal != _hash(payload):
                raise FormatError("it is not what was sent: the link to its sender broke during transmission")
            return number, time_ns, gid
    if size != _LAYOUT.size or data[16] != GID_BYTES:
        if data.startswith(_OLD):
            raise FormatError("the sender's rmw_zenoh is too old (before Jazzy 0.2.4, Humble 0.1.2): update it")
        # The message leaves out the bytes, which differ each time: a problem that should be reported once would be
        # reported with each message.
        raise FormatError(f"no attachment of 33 bytes, but one of {size} that is not sealed as ours are")
    return _FIELDS.unpack(data)


def _hash(payload: bytes) -> int:
    return xxh3_64_intdigest(payload if len(payload) <= SEALED else memoryview(payload)[-SEALED:])
