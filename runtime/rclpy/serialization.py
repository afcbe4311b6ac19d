"""Serialization of messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl import cdr
from rclpy._rclpy_pybind11 import RMWError
from rclpy.type_support import check_is_valid_msg_type

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message


def serialize_message(message: Message) -> bytes:
    """Serialize a message as a middleware does: CDR version 1, little endian.

    Raises `TypeError` if a field holds a value that cannot be serialized.
    """
    check_is_valid_msg_type(type(message))
    return cdr.serialize(message)


def deserialize_message(serialized_message: bytes, message_type: object) -> Any:
    """Deserialize a message of a class; raises `RMWError` (a `RuntimeError`) for bytes that are not one."""
    check_is_valid_msg_type(message_type)
    try:
        return cdr.deserialize(serialized_message, message_type)
    except cdr.CdrError as error:
        raise RMWError(f"failed to deserialize ROS message: {error}") from None
