"""Fills messages from plain values, as `ros2 topic pub` does."""

from __future__ import annotations

import copy
from array import array
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from rosidl_parser.definition import AbstractNestedType, NamespacedType
from rosidl_runtime_py.convert import get_message_slot_types
from rosidl_runtime_py.import_message import import_message_from_namespaced_type

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message

Setter = Callable[[Any], None]


def set_message_fields(
    msg: Message, values: dict[str, Any], expand_header_auto: bool = False, expand_time_now: bool = False
) -> list[Setter]:
    """Set fields by name; return functions that set the times that were given as `auto` or `now`.

    Raises `AttributeError` for an unknown field, `TypeError` or `ValueError` for an invalid value.
    """
    filling = _Filling(expand_header_auto, expand_time_now)
    filling.fill(msg, values)
    return filling.times


class _Filling:
    def __init__(self, auto: bool, now: bool) -> None:
        self._auto, self._now = auto, now
        self.times: list[Setter] = []

    def fill(self, msg: Message, values: Any) -> None:
        values = copy.deepcopy(values)
        if not hasattr(values, "items"):
            kind = type(values).__name__
            raise TypeError(f"Value '{values}' is expected to be a dictionary but is a {kind}")
        for name, value in values.items():
            field = getattr(msg, name)
            if not self._is_time(msg, name, field, value):
                self._set(msg, name, field, value)

    def _is_time(self, msg: Message, name: str, field: object, value: object) -> bool:
        """Whether the value means the current time, which is set later."""
        kind = f"{type(field).__module__}.{type(field).__name__}"
        if self._auto and value == "auto" and kind == "std_msgs.msg._header.Header":
            self.times.append(partial(setattr, field, "stamp"))
        elif self._now and value == "now" and kind == "builtin_interfaces.msg._time.Time":
            self.times.append(partial(setattr, msg, name))
        else:
            return False
        return True

    def _set(self, msg: Message, name: str, field: Any, value: Any) -> None:
        value = self._converted(field, value)
        kind = get_message_slot_types(msg)[name]
        if isinstance(kind, AbstractNestedType) and isinstance(kind.value_type, NamespacedType):
            cls = import_message_from_namespaced_type(kind.value_type)
            for index, each in enumerate(value):
                inner = cls()
                self.fill(inner, each)
                value[index] = inner
        setattr(msg, name, value)

    def _converted(self, field: Any, value: Any) -> Any:
        """Return the value converted to the type of the field's current value."""
        kind = type(field)
        if kind is array:
            return array(field.typecode, value)
        if kind.__name__ == "ndarray":
            import numpy

            return numpy.array(value, dtype=field.dtype)
        if type(value) is kind:
            return value
        try:
            return kind(value)
        except TypeError:
            inner = kind()
            self.fill(inner, value)
            return inner
