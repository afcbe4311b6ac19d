"""Message definitions in MCAP's `ros2msg` encoding: the type, then all types it uses, separated by lines of `=`.

They are derived from the message classes, which describe their fields in every ROS 2 distribution, so no definition
files are needed. Constants and comments are left out because readers do not need them.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator
from typing import Any

BORDER = "=" * 80
NAMES = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}
"""Primitive types that are named differently in classes (as in IDL) and in message definitions."""


def definition(kind: Any) -> str:
    """The definition of a message class, followed by all types it uses; empty if the class does not list its fields."""
    if getattr(kind, "get_fields_and_field_types", None) is None:
        return ""
    parts = [f"{_fields(kind)}"]
    parts += [f"{BORDER}\nMSG: {name}\n{_fields(each)}" for name, each in _used_types(kind, {})]
    return "\n".join(parts)


def class_of(type_name: str) -> Any:
    """The class of a message type; raises `ValueError`, `ImportError` or `AttributeError` if there is none."""
    from rosidl_runtime_py.utilities import get_message

    try:
        return get_message(type_name)
    except TypeError:  # the name lacks a package
        raise ValueError(f"'{type_name}' is not a message type") from None


def interface_type_name(kind: Any) -> str:
    """The type name, `package/msg/Name`, of a message class."""
    package, _, rest = kind.__module__.partition(".")
    return f"{package}/{rest.split('.')[0]}/{kind.__name__}"


def _used_types(kind: Any, found: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    for text in kind.get_fields_and_field_types().values():
        name = _element_type(text)
        if "/" in name and name not in found:
            found[name] = field_class(name, kind)
            yield name, found[name]
            yield from _used_types(found[name], found)


def field_class(name: str, user: Any) -> Any:
    """The class of a field's type, found in the module of the containing class if both belong to an action."""
    package, _, message = name.partition("/")
    beside = getattr(importlib.import_module(user.__module__), message, None)
    if beside is not None and beside.__module__.startswith(f"{package}."):
        return beside
    return getattr(importlib.import_module(f"{package}.msg"), message)


def _fields(kind: Any) -> str:
    lines = (f"{_ros2msg_type(text)} {name}" for name, text in kind.get_fields_and_field_types().items())
    return "\n".join(lines) + "\n"


def _element_type(text: str) -> str:
    """The type of a field, or of its elements if it is an array or a sequence."""
    inside = re.fullmatch(r"sequence<(.*?)(?:, \d+)?>", text)
    return re.sub(r"\[\d+\]$", "", inside[1] if inside else text)


def _ros2msg_type(text: str) -> str:
    """A field type in message definition syntax: `sequence<double, 3>` becomes `float64[<=3]`."""
    if sequence := re.fullmatch(r"sequence<(.*?)(?:, (\d+))?>", text):
        return f"{_primitive_type(sequence[1])}[{f'<={sequence[2]}' if sequence[2] else ''}]"
    if array := re.fullmatch(r"(.*)\[(\d+)\]", text):
        return f"{_primitive_type(array[1])}[{array[2]}]"
    return _primitive_type(text)


def _primitive_type(text: str) -> str:
    bounded = re.fullmatch(r"(w?string)<(\d+)>", text)
    return f"{bounded[1]}<={bounded[2]}" if bounded else NAMES.get(text, text)
