"""Classes and field types of messages, services and actions, through the public names of rosidl."""

from __future__ import annotations

import importlib
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from bot_console.tui.console.topics.port import Payload

FOLDERS = {Payload.MESSAGE: "msg", Payload.REQUEST: "srv", Payload.GOAL: "action"}
ARRAY = re.compile(r"sequence<(?P<of>[^,]+?)(?:,\s*\d+)?>|(?P<fixed>.+)\[(?P<count>\d+)\]")
INTEGERS = {f"{sign}int{bits}": bits for sign in ("", "u") for bits in (8, 16, 32, 64)}
REALS = ("float", "double")
TIMES = ("builtin_interfaces/Time", "builtin_interfaces/Duration")
QUATERNION = "geometry_msgs/Quaternion"
HEADER = "std_msgs/Header"


def message_named(type_name: str) -> Any:
    """The class of a message, also of an action's feedback or a service's event (`std_srvs/srv/Trigger_Event`).

    Raises `ImportError` or `AttributeError` if it is not installed; also `ValueError` or `TypeError` if the name is
    invalid.
    """
    package, _, rest = type_name.partition("/")
    folder, _, name = rest.rpartition("/")
    owner, _, part = name.rpartition("_")
    if (folder, part) == ("action", "FeedbackMessage"):
        return getattr(importlib.import_module(f"{package}.action"), owner).Impl.FeedbackMessage
    if (folder, part) == ("srv", "Event"):
        return getattr(importlib.import_module(f"{package}.srv"), owner).Event
    return getattr(importlib.import_module(f"{package}.msg"), name)


def interface(payload: Payload, type_name: str) -> Any:
    """The class of a type such as `std_srvs/srv/SetBool`; raises `ValueError` if it is not installed."""
    package, _, rest = type_name.partition("/")
    try:
        if payload is Payload.MESSAGE:
            return message_named(type_name)
        return getattr(importlib.import_module(f"{package}.{FOLDERS[payload]}"), rest.rsplit("/", 1)[-1])
    except (ImportError, AttributeError):
        raise ValueError(f"the type {type_name} is not available here; source the workspace that provides it") from None


def filled_class(payload: Payload, type_name: str) -> Any:
    """The class of the message to fill in: the message itself, a service request, or an action goal."""
    found = interface(payload, type_name)
    return {
        Payload.MESSAGE: found,
        Payload.REQUEST: getattr(found, "Request", None),
        Payload.GOAL: getattr(found, "Goal", None),
    }[payload]


def fields_of(message: Any) -> Mapping[str, str]:
    """The names and types of the fields of a message or of its class."""
    return message.get_fields_and_field_types()


def is_message(type_name: str) -> bool:
    """Whether a field type is a message, and not an array of messages."""
    return "/" in type_name and not ARRAY.fullmatch(type_name)


def element_type(type_name: str) -> str:
    """The element type of an array; empty if the type is not an array."""
    found = ARRAY.fullmatch(type_name)
    return (found["of"] or found["fixed"]).strip() if found else ""


def full_type_name(field_type: str) -> str:
    """Convert `geometry_msgs/Point` to `geometry_msgs/msg/Point`."""
    package, _, name = field_type.partition("/")
    return f"{package}/msg/{name}"


def short_name(type_name: str) -> str:
    """Convert `geometry_msgs/msg/Point` to `geometry_msgs/Point`."""
    package, _, rest = type_name.partition("/")
    return f"{package}/{rest.rsplit('/', 1)[-1]}"


def constants(message: Any) -> Mapping[str, Mapping[int, str]]:
    """The names of values, for each integer field of a message whose values are named by constants."""
    return constants_of(message.__class__)


@lru_cache(maxsize=512)
def constants_of(message_class: Any) -> Mapping[str, Mapping[int, str]]:
    """The same for a message class.

    A constant belongs to the field with whose name it begins; if there is no such field, it belongs to the only
    one-byte field, provided that there is exactly one.
    """
    fields = {name: kind for name, kind in fields_of(message_class).items() if kind in INTEGERS or kind == "octet"}
    found: dict[str, dict[int, str]] = {}
    rest: dict[int, str] = {}
    for name in (each for each in dir(message_class) if each.isupper() and not each.startswith("_")):
        value = getattr(message_class, name)
        number = value[0] if isinstance(value, bytes) and len(value) == 1 else value
        if not isinstance(number, int) or isinstance(number, bool):
            continue
        owner = max((each for each in fields if name.startswith(f"{each.upper()}_")), key=len, default="")
        if owner:
            found.setdefault(owner, {})[number] = name.removeprefix(f"{owner.upper()}_")
        elif number in rest:
            rest[number] = ""  # the same value has two names, so they belong to different fields
        else:
            rest[number] = name
    small = [name for name, kind in fields.items() if name not in found and kind in ("uint8", "int8", "octet")]
    if len(small) == 1 and rest and all(rest.values()):
        found[small[0]] = rest
    return found
