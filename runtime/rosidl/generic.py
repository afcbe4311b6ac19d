"""Message classes for types without a definition here: their messages are serialized bytes, as in rclcpp's
GenericSubscription and GenericPublisher.
"""

from __future__ import annotations

from functools import cache
from typing import Any, ClassVar

from bot_console.runtime.rosidl.message import Message, MessageType
from bot_console.runtime.rosidl.type_hash import digest_from


class GenericMessage(Message):
    """A message of which only the serialized bytes are known; only raw subscriptions receive it."""

    __slots__ = ("data",)
    get_fields_and_field_types: ClassVar[Any] = None
    """None, as the fields are unknown."""
    _given_digest: ClassVar[bytes] = b""
    """The hash of the type, which cannot be computed without a definition."""

    def __init__(self, data: bytes) -> None:
        self.data = data

    def _copy_(self) -> GenericMessage:
        """Return the message itself, as its bytes never change."""
        return self

    def _to_bytes(self) -> bytes:
        """Return the bytes, with their header."""
        return self.data


@cache
def generic_class(type_name: str, type_hash: str) -> type[GenericMessage]:
    """Return the class of a type, given its name (`package/msg/Name`) and its hash (`RIHS01_...`).

    Raises `ValueError` if either is malformed.
    """
    package, _, rest = type_name.partition("/")
    kind, _, name = rest.partition("/")
    if not all(each.isidentifier() for each in (package, kind, name)):
        raise ValueError(f"'{type_name}' is not a message type")
    body: dict[str, Any] = {
        "__slots__": (),
        "__module__": f"{package}.{kind}.generic",
        "_fields_and_field_types": {},
        "_given_digest": digest_from(type_hash),
    }
    return MessageType(name, (GenericMessage,), body)
