"""Parameter descriptors with ranges, as declared by every node of this package.

All ranges have the step 0, which makes them continuous, since a node refuses values between steps instead of rounding
them. Descriptions end with the unit.
"""

from __future__ import annotations

from collections.abc import Iterable

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


def number(description: str, low: float, high: float) -> ParameterDescriptor:
    """The descriptor of a double from `low` to `high`."""
    span = FloatingPointRange(from_value=low, to_value=high, step=0.0)
    return ParameterDescriptor(description=description, floating_point_range=[span])


def whole(description: str, low: int, high: int) -> ParameterDescriptor:
    """The descriptor of an integer from `low` to `high`."""
    return ParameterDescriptor(description=description, integer_range=[IntegerRange(from_value=low, to_value=high)])


def plain(description: str) -> ParameterDescriptor:
    """The descriptor of a value without a range."""
    return ParameterDescriptor(description=description)


def fixed(description: str) -> ParameterDescriptor:
    """The descriptor of a value that is read only at startup."""
    return ParameterDescriptor(description=description, read_only=True)


def proposed(node: Node, changes: Iterable[Parameter], *names: str) -> list[float]:
    """Return the values that numeric parameters would have after changes, for rules that involve several of them."""
    after = {each.name: each.value for each in changes}
    return [float(after[name] if name in after else node.get_parameter(name).value) for name in names]


def accepted() -> SetParametersResult:
    """The result of a callback that accepts a change."""
    return SetParametersResult(successful=True)


def refused(reason: str) -> SetParametersResult:
    """The result of a callback that refuses a change."""
    return SetParametersResult(successful=False, reason=reason)
