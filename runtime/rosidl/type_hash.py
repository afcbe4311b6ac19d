"""Hashes of interfaces: RIHS01, the SHA-256 of the type description in canonical JSON (REP 2016)."""

from __future__ import annotations

import json
from functools import cache
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl.conversion import type_name

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.type_description import Description

VERSION = 1
SCHEME = f"RIHS{VERSION:02}_"
DIGEST_BYTES = 32


@cache
def digest(cls: Any) -> bytes:
    """Return the 32-byte hash of a message, service or action class."""
    given = getattr(cls, "_given_digest", b"")
    if given:
        return given
    known = KNOWN.get(type_name(cls))
    if known:
        return bytes.fromhex(known)
    from bot_console.runtime.rosidl.type_description import describe

    return digest_of_description(describe(cls))


def digest_of_description(description: Description) -> bytes:
    """Return the 32-byte hash of an interface of which only the description is known."""
    from hashlib import sha256  # imported late, as it loads OpenSSL

    return sha256(json.dumps(description, separators=(", ", ": ")).encode()).digest()


def text(cls: object) -> str:
    """Return the hash in ROS 2's notation: `RIHS01_` and 64 digits."""
    return _text(digest(cls))


def text_of_description(description: Description) -> str:
    """Return the hash, in the same notation, of an interface of which only the description is known."""
    return _text(digest_of_description(description))


def _text(hashed: bytes) -> str:
    return SCHEME + hashed.hex()


def digest_from(text: str) -> bytes:
    """Parse a hash in the same notation; raises `ValueError` for any other text."""
    scheme, digits = text[: len(SCHEME)], text[len(SCHEME) :]
    try:
        found = bytes.fromhex(digits) if scheme == SCHEME else b""
    except ValueError:
        found = b""
    if len(found) != DIGEST_BYTES:
        raise ValueError(f"'{text}' is not the hash of a type")
    return found


KNOWN = {
    "rcl_interfaces/msg/Log": "e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac",
    "rcl_interfaces/msg/ParameterEvent": "043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204",
    "rcl_interfaces/srv/DescribeParameters": "845b484d71eb0673dae682f2e3ba3c4851a65a3dcfb97bddd82c5b57e91e4cff",
    "rcl_interfaces/srv/GetLoggerLevels": "03bf1bebd0d6514c7ed0ba7c5e08dc9f2f39c759fe99e1e30ea4157d7674f72d",
    "rcl_interfaces/srv/GetParameterTypes": "da199c878688b3e530bdfe3ca8f74cb9fa0c303101e980a9e8f260e25e1c80ca",
    "rcl_interfaces/srv/GetParameters": "bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc",
    "rcl_interfaces/srv/ListParameters": "3e6062bfbb27bfb8730d4cef2558221f51a11646d78e7bb30a1e83afac3aad9d",
    "rcl_interfaces/srv/SetLoggerLevels": "3ff86cb4e91fbf9abae15c234ecc874448de6ece8e193401c077cf116e4f6d78",
    "rcl_interfaces/srv/SetParameters": "56eed9a67e169f9cb6c1f987bc88f868c14a8fc9f743a263bc734c154015d7e0",
    "rcl_interfaces/srv/SetParametersAtomically": "0e192ef259c07fc3c07a13191d27002222e65e00ccec653ca05e856f79285fcd",
    "rosgraph_msgs/msg/Clock": "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
    "type_description_interfaces/srv/GetTypeDescription": (
        "69b9c19c1021405984cc60dbbb1edceb147a6538b411d812ba6afabeed962cd5"
    ),
}
