"""Hashes of interfaces: RIHS01, the SHA-256 of the type description in canonical JSON (REP 2016)."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl.conversion import type_name
from bot_console.runtime.rosidl.known_hashes import KNOWN

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.type_description import Description

VERSION = 1


@cache
def digest(cls: Any) -> bytes:
    """Return the 32-byte hash of a message, service or action class."""
    known = KNOWN.get(type_name(cls))
    if known:
        return bytes.fromhex(known)
    from bot_console.runtime.rosidl.type_description import describe

    return digest_of_description(describe(cls))


def digest_of_description(description: Description) -> bytes:
    """Return the 32-byte hash of an interface known only by its description."""
    import json
    from hashlib import sha256  # imported late, as it loads OpenSSL

    return sha256(json.dumps(description, separators=(", ", ": ")).encode()).digest()


def text(cls: Any) -> str:
    """Return the hash in ROS 2's notation: `RIHS01_` and 64 digits."""
    return _text(digest(cls))


def text_of_description(description: Description) -> str:
    """Return the hash, in that notation, of an interface known only by its description."""
    return _text(digest_of_description(description))


def _text(hashed: bytes) -> str:
    return f"RIHS{VERSION:02}_{hashed.hex()}"
