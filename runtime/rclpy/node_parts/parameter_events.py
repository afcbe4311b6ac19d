"""The messages published on `/parameter_events`."""

# pyright: reportPrivateUsage=false
# The modules of rclpy are one library: what its users are not to touch has an underscore, as upstream.

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterEvent, ParameterValue
from rclpy.impl.parameter_values import FIELDS
from rclpy.parameter import Parameter

CARRIED_AS_THEY_ARE = frozenset((bool, float, str))
"""Classes all of whose values are transmitted unchanged."""
INT64 = 1 << 63
NANO = 1_000_000_000


def parameter_event(node: str, now: int, new: list[Any], changed: list[Any], deleted: list[Any]) -> ParameterEvent:
    """The parameter event of a node (full name) at a time (ns)."""
    seconds, nanoseconds = divmod(now, NANO)
    return ParameterEvent(
        stamp=Time(sec=seconds, nanosec=nanoseconds, check_fields=False),
        node=node,
        new_parameters=new,
        changed_parameters=changed,
        deleted_parameters=deleted,
        check_fields=False,
    )


def check_carried(parameter: Parameter) -> None:
    """Raise what `event_parameter` would, without creating a message for values that need no check.

    A message is seven objects for the garbage collector: for ten thousand that nobody receives, they would take two
    thirds of the time to set those parameters.
    """
    value = parameter._value
    kind = value.__class__
    _check_text(parameter)
    if kind not in CARRIED_AS_THEY_ARE and not (kind is int and -INT64 <= value < INT64):
        event_parameter(parameter)


def _check_text(parameter: Parameter) -> None:
    """Raise `UnicodeEncodeError` for a name or value with half a character, as a file name of any bytes may have."""
    value: Any = parameter._value
    texts: Any = value if value.__class__ is list or value.__class__ is tuple else (value,)
    for text in (parameter._name, *texts):
        if text.__class__ is str and not text.isascii():
            text.encode()


def event_parameter(parameter: Parameter) -> ParameterMsg:
    """A parameter as a well-formed message for an event.

    Raises `FieldTypeError` or, for text that is not Unicode, `UnicodeEncodeError` if it cannot be serialized.
    """
    _check_text(parameter)
    code = parameter._type_._value_
    value = ParameterValue(type=code, check_fields=False)
    message = ParameterMsg(name=parameter._name, value=value, check_fields=False)
    if not code:
        return message
    given = parameter._value
    setattr(value, FIELDS[code], given)
    return message if given.__class__ in CARRIED_AS_THEY_ARE else message._copy_()
