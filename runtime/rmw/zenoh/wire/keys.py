"""The keys of topics and services, and the encoding of names and types in them, as in rmw_zenoh.

A key ends with the hash of the type, so two sides with different definitions of a type do not receive each other's
messages.
"""

from __future__ import annotations


class FormatError(ValueError):
    """A text or bytes that violate the format; the message says what is wrong."""


def dds_type(type_name: str) -> str:
    """`std_msgs/msg/String` as `std_msgs::msg::dds_::String_`."""
    package, kind, short = type_name.split("/")
    return f"{package}::{kind}::dds_::{short}_"


def ros_type(dds: str) -> str:
    """`std_msgs::msg::dds_::String_` as `std_msgs/msg/String`; raises `FormatError`."""
    parts = dds.split("::")
    if len(parts) != 4 or parts[2] != "dds_" or not parts[3].endswith("_") or not all(parts):
        raise FormatError(f"no type of ROS: {dds!r}")
    return f"{parts[0]}/{parts[1]}/{parts[3][:-1]}"


def data_key(domain: int, name: str, type_name: str, type_hash: str) -> str:
    """Return the key of a topic or service; `name` is fully qualified."""
    return f"{domain}/{name.strip('/')}/{dds_type(type_name)}/{type_hash}"


def mangle(name: str) -> str:
    """Encode a name as one part of a key: each slash becomes a per cent sign, as does the empty name."""
    return name.replace("/", "%") or "%"


def demangle(part: str) -> str:
    """Decode a name from a part of a key."""
    return part.replace("%", "/")
