"""Serialization of messages."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.rosidl import cdr
from rclpy._rclpy_pybind11 import RMWError
from rclpy.type_support import check_is_valid_msg_type


def serialize_message(message: Any) -> bytes:
    """The bytes of a message as a middleware sends it: CDR version 1, little endian.

    Raises `TypeError` where a field holds what cannot be sent.
    """
    check_is_valid_msg_type(type(message))
    return cdr.serialize(message)


def deserialize_message(serialized_message: bytes, message_type: Any) -> Any:
    """The message of a class that bytes are; raises `RMWError` (a `RuntimeError`) where they are none."""
    check_is_valid_msg_type(message_type)
    try:
        return cdr.deserialize(serialized_message, message_type)
    except cdr.CdrError as error:
        raise RMWError(f"failed to deserialize ROS message: {error}") from None
