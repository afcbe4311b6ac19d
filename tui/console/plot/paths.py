"""Finds the paths of a message type that can be plotted: its numbers, arrays and quaternions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from bot_console.tui.console.bags.definitions import field_class
from bot_console.tui.console.plot.arrays import NotPlottable
from bot_console.tui.console.topics.interfaces import message_named

MAX_DEPTH = 4
"""Depth to which nested messages are searched."""
ARRAY = re.compile(r"sequence<([^,>]+).*>|(.+?)\[\d+\]")
WHOLE = ("min", "max", "mean")
"""Functions of whole arrays that are suggested in addition to the first element."""


def plottable_class(type_name: str) -> Any:
    """The class of a type such as `std_msgs/msg/String`; raises `NotPlottable` if it is not installed."""
    try:
        return message_named(type_name)
    except (ImportError, AttributeError, TypeError, ValueError):  # the latter two if the type name is not valid
        raise NotPlottable(f"the message type {type_name} is not known here") from None


def number_paths(type_name: str) -> tuple[str, ...]:
    """The paths to the numbers of a type: fields first, then elements of arrays, then functions of whole arrays."""
    fields: list[str] = []
    elements: list[str] = []
    made: list[str] = []
    for path, kind in _leaves_of(type_name):
        array = ARRAY.fullmatch(kind)
        if kind.endswith("/Quaternion"):
            made.append(f"{path}.yaw()")
        elif array is None:
            fields.append(path)
        else:
            elements.append(f"{path}[0]")
            made += [f"{path}.{each}()" for each in WHOLE]
    return (*fields, *elements, *made)


def example(type_name: str) -> str:
    """An example of a path of this type that can be plotted."""
    return next(iter(number_paths(type_name)), "data")


def _leaves_of(type_name: str) -> Iterator[tuple[str, str]]:
    try:
        message = plottable_class(type_name)
    except NotPlottable:
        return
    yield from _leaves(message, MAX_DEPTH)


def _leaves(message: Any, depth: int) -> Iterator[tuple[str, str]]:
    """The paths and types of numbers, arrays of numbers and quaternions in a message class."""
    fields: dict[str, str] = message.get_fields_and_field_types()
    for name, kind in fields.items():
        array = ARRAY.fullmatch(kind)
        if _is_number((array[1] or array[2]) if array else kind):
            yield name, kind
        elif array is None and "/" in kind and depth > 1:
            if kind.endswith("/Quaternion"):
                yield name, kind
            for path, below in _leaves_below(kind, message, depth - 1):
                yield f"{name}.{path}", below


def _leaves_below(kind: str, message: Any, depth: int) -> Iterator[tuple[str, str]]:
    with suppress(ImportError, AttributeError):
        yield from _leaves(field_class(kind, message), depth)


def _is_number(kind: str) -> bool:
    return kind in ("boolean", "float", "double", "octet") or re.fullmatch(r"u?int(8|16|32|64)", kind) is not None
