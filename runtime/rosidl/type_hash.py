"""Hashes of interfaces: RIHS01, the SHA-256 of the type description in canonical JSON (REP 2016)."""

from __future__ import annotations

import json
from functools import cache
from hashlib import sha256
from typing import Any

from bot_console.runtime.rosidl.type_description import Description, describe

VERSION = 1


@cache
def digest(cls: Any) -> bytes:
    """The 32 bytes of the hash of a message, service or action class."""
    return _digest(describe(cls))


def _digest(description: Description) -> bytes:
    return sha256(json.dumps(description, separators=(", ", ": ")).encode()).digest()


def text(cls: Any) -> str:
    """The hash as ROS 2 writes it: `RIHS01_` and 64 digits."""
    return _text(digest(cls))


def text_of_description(description: Description) -> str:
    """The hash of an interface of which nothing but its description is known."""
    return _text(_digest(description))


def _text(hashed: bytes) -> str:
    return f"RIHS{VERSION:02}_{hashed.hex()}"
