"""The refusals predicted by the console are those of rclpy, as far as the descriptor allows a prediction."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, Range
from bot_console.tui.console.values import refusal
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.node_parts.parameter_setting import refusal as rclpy_refusal
from rclpy.parameter import Parameter

DOUBLES, INTEGERS = Range(0.1, 2.0, 0.1), Range(1, 10, 4)
CASES = [
    *((DOUBLES, value) for value in (0.1, 0.3, 0.30000001, 0.35, 2.0, 1.95, 2.1, 0.0)),
    *((INTEGERS, value) for value in (1, 5, 9, 10, 4, 8, 0, 11)),
]


@pytest.mark.parametrize(("limits", "value"), CASES)
def test_steps_are_rounded_as_in_rclpy(limits: Range, value: float) -> None:
    integer = limits is INTEGERS
    kind = Kind.INTEGER if integer else Kind.DOUBLE
    descriptor = ParameterDescriptor(type=int(kind))
    if integer:
        descriptor.integer_range = [IntegerRange(from_value=1, to_value=10, step=4)]
    else:
        descriptor.floating_point_range = [FloatingPointRange(from_value=0.1, to_value=2.0, step=0.1)]
    message = rclpy_refusal(
        Parameter("speed", value=value), descriptor, check_read_only=True, declared=True, tolerance=Node.PARAM_REL_TOL
    )
    who, why = refusal(ParameterInfo("/n", "speed", kind, value, range=limits), value)
    assert (who, bool(why)) == (("descriptor", True) if message else ("", False))
