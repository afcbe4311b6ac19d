"""Interface classes by their full name, such as `std_msgs/msg/String`."""

from __future__ import annotations

from typing import Any

from rosidl_parser.definition import NamespacedType
from rosidl_runtime_py.import_message import import_message_from_namespaced_type


def get_interface(identifier: str) -> Any:
    """Return the class of any interface; raises `ImportError` or `AttributeError` if there is none."""
    return import_message_from_namespaced_type(get_namespaced_type(identifier))


def get_message(identifier: str) -> Any:
    """Return the class of a message, also for `std_msgs/String`; raises `ValueError` for a service or action."""
    interface = import_message_from_namespaced_type(get_message_namespaced_type(identifier))
    if not is_message(interface):
        raise ValueError(f"Expected the full name of a message, got '{identifier}'")
    return interface


def get_service(identifier: str) -> Any:
    """Return the class of a service, also for `std_srvs/Trigger`; raises `ValueError` for a message or action."""
    interface = import_message_from_namespaced_type(get_service_namespaced_type(identifier))
    if not is_service(interface):
        raise ValueError(f"Expected the full name of a service, got '{identifier}'")
    return interface


def get_action(identifier: str) -> Any:
    """Return the class of an action, also for `example_interfaces/Fibonacci`; raises `ValueError` for anything else."""
    interface = import_message_from_namespaced_type(get_action_namespaced_type(identifier))
    if not is_action(interface):
        raise ValueError(f"Expected the full name of an action, got '{identifier}'")
    return interface


def get_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type with a full name."""
    return _namespaced(identifier)


def get_message_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type with a message's name, which may lack `msg`."""
    return _namespaced(identifier, "msg")


def get_service_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type with a service's name, which may lack `srv`."""
    return _namespaced(identifier, "srv")


def get_action_namespaced_type(identifier: str) -> NamespacedType:
    """Return the type with an action's name, which may lack `action`."""
    return _namespaced(identifier, "action")


def _namespaced(identifier: str, kind: str = "") -> NamespacedType:
    *namespaces, name = identifier.split("/")
    if len(namespaces) == 1 and kind:
        namespaces.append(kind)
    return NamespacedType(namespaces, name)


def is_message(interface: object) -> bool:
    """Whether an object is a message class or a message."""
    return hasattr(interface, "SLOT_TYPES")


def is_service(interface: object) -> bool:
    """Whether an object is a service class."""
    return hasattr(interface, "Request") and hasattr(interface, "Response")


def is_action(interface: object) -> bool:
    """Whether an object is an action class."""
    return all(hasattr(interface, part) for part in ("Goal", "Result", "Feedback"))
