"""The attachment of each message, request and response: number, time and sender, in rmw_zenoh's 33 bytes.

Ours end with a seal, a hash of these bytes, of the payload and of the key that it was sent to, which rmw_zenoh ignores.
When Zenoh cuts the link to a process that does not read, it stops in the middle of a message but still writes what is
queued behind it: the rest of that message then consists of foreign bytes, which would be taken for the end of a command
or a parameter. The key is part of it because a message names its key by a number that the two ends of a link have
agreed on: one wrong byte, and a request arrives at another service.
"""

from __future__ import annotations

import struct

from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from xxhash import xxh3_64_intdigest, xxh3_128_intdigest

GID_BYTES = 16
_LAYOUT = struct.Struct("<qqB16s")
_FIELDS = struct.Struct("<qqx16s")
"""The same layout, skipping the byte that holds the length of the id."""
_MARK = b"xxh3"
_SEAL = struct.Struct("<4sQ")
_SEALED_SIZE = _LAYOUT.size + _SEAL.size
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


def key_hash_of(key: str) -> int:
    """Return the hash of a topic's or service's key that goes into a seal."""
    return xxh3_64_intdigest(key.encode())


def pack(number: int, time_ns: int, gid: bytes, payload: bytes | None = None, key_hash: int = 0) -> bytes:
    """Return the attachment as bytes; sealed if a payload, with the hash of the key it is sent to, is given."""
    unsealed = _LAYOUT.pack(number, time_ns, GID_BYTES, gid)
    return unsealed if payload is None else unsealed + _SEAL.pack(_MARK, _hash(unsealed, payload, key_hash))


def unpack(data: bytes | None, payload: bytes | None = None, key_hash: int = 0) -> Attachment:
    """Parse an attachment.

    Raises `FormatError` if the layout is different, with the rmw_zenoh releases known to write another one, or if it is
    sealed and `payload` is not what was sent to the key with this hash.
    """
    if data is None:
        raise FormatError("a message without attachment: its sender does not speak the format of rmw_zenoh")
    size = len(data)
    if size == _SEALED_SIZE and data[16] == GID_BYTES:
        unsealed = data[: _LAYOUT.size]
        mark, seal = _SEAL.unpack_from(data, _LAYOUT.size)
        if mark == _MARK:
            if payload is not None and seal != _hash(unsealed, payload, key_hash):
                raise FormatError("it is not what was sent here: the link to its sender broke during transmission")
            return _FIELDS.unpack(unsealed)
    if size != _LAYOUT.size or data[16] != GID_BYTES:
        if data.startswith(_OLD):
            raise FormatError("the sender's rmw_zenoh is too old (before Jazzy 0.2.4, Humble 0.1.2): update it")
        # The message leaves out the bytes, which differ each time: a problem that should be reported once would be
        # reported with each message.
        raise FormatError(f"no attachment of 33 bytes, but one of {size} that is not sealed as ours are")
    return _FIELDS.unpack(data)


def _hash(unsealed: bytes, payload: bytes, key_hash: int) -> int:
    end = payload if len(payload) <= SEALED else memoryview(payload)[-SEALED:]
    return xxh3_64_intdigest(end, xxh3_64_intdigest(unsealed, key_hash))
