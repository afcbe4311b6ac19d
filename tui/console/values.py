"""Converts parameter values between ROS messages, the model, and text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bot_console.tui.console.model import Kind, ParameterInfo, Range, Value
from bot_console.tui.console.parameter_types import ARRAYS, TYPES, field_of
from bot_console.tui.console.parameters.origin_text import START
from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterValue


def from_message(message: ParameterValue) -> Value:
    """The value in a `rcl_interfaces/msg/ParameterValue`."""
    kind = _kind(message.type)
    if kind is Kind.NOT_SET:
        return None
    value: Any = getattr(message, field_of(kind))
    return tuple(value) if kind in ARRAYS else value


def _kind(code: int) -> Kind:
    """The kind for a code in a message, which may be any number."""
    return Kind(code) if code in TYPES else Kind.NOT_SET


def kind_of(value: Value, declared: Kind = Kind.NOT_SET) -> Kind:
    """The kind of a value; an empty array takes the declared one. Raises `ValueError` for a mixed array."""
    if value is None:
        return Kind.NOT_SET
    if isinstance(value, tuple):
        if not value:
            return declared if declared in ARRAYS else Kind.STRING_ARRAY
        for kind in ARRAYS:
            if all(type(each) is TYPES[kind].python for each in value):
                return kind
        raise ValueError(f"the elements of {list(value)!r} are not of one type")
    return next(kind for kind, row in TYPES.items() if row.element is None and isinstance(value, row.python))


def to_message(name: str, value: Value, declared: Kind = Kind.NOT_SET) -> Parameter:
    """A `rcl_interfaces/msg/Parameter`; raises `ValueError` for a value that no parameter can hold."""
    kind = kind_of(value, declared)
    message = ParameterValue(type=int(kind))
    if kind is Kind.INTEGER and not -(2**63) <= int(value) < 2**63:  # type: ignore[arg-type] -- an integer, as its kind says
        raise ValueError(f"{value} does not fit into 64 bits")
    if kind is not Kind.NOT_SET:
        setattr(message, field_of(kind), list(value) if isinstance(value, tuple) else value)
    return Parameter(name=name, value=message)


def info(
    node: str, value: ParameterValue, descriptor: ParameterDescriptor, first: ParameterInfo | None
) -> ParameterInfo:
    """The parameter as shown in the console; `first` is its earlier state, for the default."""
    now, kind = from_message(value), _kind(value.type) or _kind(descriptor.type)
    ranges = {Kind.DOUBLE: descriptor.floating_point_range, Kind.INTEGER: descriptor.integer_range}
    return ParameterInfo(
        node=node,
        name=descriptor.name,
        kind=kind,
        value=now,
        description=descriptor.description,
        read_only=descriptor.read_only,
        dynamic=descriptor.dynamic_typing,
        range=_range(ranges.get(kind, ())),
        constraints=descriptor.additional_constraints,
        default=first.default if first else now,
        origin=first.origin if first else START,
    )


def _range(ranges: Sequence[Any]) -> Range | None:
    if not len(ranges):
        return None
    ends = ranges[0].from_value, ranges[0].to_value
    return Range(min(ends), max(ends), ranges[0].step)


def refusal(parameter: ParameterInfo | None, value: Value) -> tuple[str, str]:
    """Who would refuse this value and why, according to the descriptor; two empty texts if it would be accepted."""
    if parameter is None:
        return "node", "the node has no such parameter"
    if parameter.read_only:
        return "descriptor", f"Trying to set a read-only parameter: {parameter.name}."
    try:
        kind = kind_of(value, parameter.kind)
    except ValueError as error:
        return "console", str(error)
    if not parameter.dynamic and parameter.kind is not Kind.NOT_SET and kind is not parameter.kind:
        return "descriptor", f"Wrong parameter type, expected 'Type.{parameter.kind.name}' got 'Type.{kind.name}'"
    limits = parameter.range
    if not limits or not isinstance(value, (int, float)) or isinstance(value, bool):
        return "", ""
    reason = limits.refusal(value)
    return ("descriptor", reason) if reason else ("", "")
