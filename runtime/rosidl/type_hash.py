"""Hashes of interfaces: RIHS01, the SHA-256 of the type description in canonical JSON (REP 2016)."""

from __future__ import annotations

import json
from functools import cache
from hashlib import sha256
from typing import Any

from bot_console.runtime.rosidl.type_description import describe

VERSION = 1


@cache
def digest(cls: Any) -> bytes:
    """The 32 bytes of the hash of a message, service or action class."""
    return sha256(json.dumps(describe(cls), separators=(", ", ": ")).encode()).digest()


def text(cls: Any) -> str:
    """The hash as ROS 2 writes it: `RIHS01_` and 64 digits."""
    return f"RIHS{VERSION:02}_{digest(cls).hex()}"
