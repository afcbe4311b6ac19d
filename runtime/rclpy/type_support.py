"""Distinguishes message, service and action classes from each other and from anything else."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.rosidl.message import Message, ServiceType
from rclpy.impl.reexports import reexporting

HINT = (
    " This might be a ROS 1 message type but it should be a ROS 2 message type."
    " Make sure to source your ROS 2 workspace after your ROS 1 workspace."
)


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Raise `AttributeError` for anything but a class made from an interface definition."""
    if isinstance(msg_or_srv_type, ServiceType):
        return
    if not (isinstance(msg_or_srv_type, type) and issubclass(msg_or_srv_type, Message)):
        raise AttributeError(f"type object '{_class_name(msg_or_srv_type)}' has no attribute '_TYPE_SUPPORT'{HINT}")


def _class_name(value: Any) -> str:
    return type(value).__name__


def check_is_valid_msg_type(msg_type: object) -> None:
    """Raise `RuntimeError` for a service or action, `AttributeError` for anything but an interface class."""
    check_for_type_support(msg_type)
    if isinstance(msg_type, ServiceType):
        raise RuntimeError(f"The message type provided is not valid ({msg_type}), this might be a service or action")


def check_is_valid_srv_type(srv_type: object) -> None:
    """Raise `RuntimeError` for a message or action, `AttributeError` for anything but an interface class."""
    check_for_type_support(srv_type)
    parts = ("Response", "Request", "Event")
    if not all(part in getattr(srv_type, "_later", ()) or hasattr(srv_type, part) for part in parts):
        raise RuntimeError(f"The service type provided is not valid ({srv_type}), this might be a message or action")


def check_is_valid_action_type(action_type: object) -> None:
    """Raise `RuntimeError` for a message or service, `AttributeError` for anything but an interface class."""
    check_for_type_support(action_type)
    if not all(hasattr(action_type, part) for part in ("Goal", "Result", "Feedback", "Impl")):
        raise RuntimeError(f"The action type provided is not valid ({action_type}), this might be a message or service")


__getattr__ = reexporting(__name__, "NoTypeSupportImportedException")
