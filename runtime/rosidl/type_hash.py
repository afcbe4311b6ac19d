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
    """The 32 bytes of the hash of a message, service or action class."""
    known = KNOWN.get(type_name(cls))
    if known:
        return bytes.fromhex(known)
    from bot_console.runtime.rosidl.type_description import describe

    return digest_of_description(describe(cls))


def digest_of_description(description: Description) -> bytes:
    """The 32 bytes of the hash of an interface of which nothing but its description is known."""
    import json
    from hashlib import sha256  # which loads OpenSSL

    return sha256(json.dumps(description, separators=(", ", ": ")).encode()).digest()


def text(cls: Any) -> str:
    """The hash as ROS 2 writes it: `RIHS01_` and 64 digits."""
    return _text(digest(cls))


def text_of_description(description: Description) -> str:
    """The hash of an interface of which nothing but its description is known."""
    return _text(digest_of_description(description))


def _text(hashed: bytes) -> str:
    return f"RIHS{VERSION:02}_{hashed.hex()}"
