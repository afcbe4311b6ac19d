"""Checks values against descriptors. A check returns None, or the reason of the refusal in rclpy's words."""

from __future__ import annotations

import math
from typing import Any

from bot_console.runtime.rmw.parameter_types import DOUBLE, INTEGER, NOT_SET


def refusal(parameter: Any, descriptor: Any, *, check_read_only: bool, declared: bool, tolerance: float) -> str | None:
    """Why a descriptor forbids a parameter, or None; sets the descriptor's name and, with dynamic typing, its type.

    `declared` says whether the parameter exists already; `tolerance` is the relative tolerance of ranges of doubles.
    """
    name, code = parameter._name, parameter._type_._value_
    descriptor.name = name
    if check_read_only and descriptor.read_only:
        return f"Trying to set a read-only parameter: {name}."
    if descriptor.dynamic_typing:
        descriptor.type = code
    elif code == NOT_SET:
        if declared:
            return "Static parameter cannot be undeclared"
    elif code != descriptor.type:
        expected = type(parameter._type_)(descriptor.type)
        return f"Wrong parameter type, expected '{expected}' got '{parameter._type_}'"
    if code == DOUBLE.code and descriptor.floating_point_range:
        return _outside_doubles(name, parameter._value, descriptor.floating_point_range[0], tolerance)
    if code == INTEGER.code and descriptor.integer_range:
        return _outside_integers(name, parameter._value, descriptor.integer_range[0])
    return None


def _outside_integers(name: str, value: int, allowed: Any) -> str | None:
    """Why an integer is out of range, or None: both ends are always allowed; steps count from the lower end."""
    low, high = sorted((allowed.from_value, allowed.to_value))
    if value in (low, high):
        return None
    if not low < value < high:
        return f"Parameter {name} out of range. Min: {low}, Max: {high}, value: {value}"
    if allowed.step and (value - low) % allowed.step:
        return (
            f"The parameter value for {name} is not a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {allowed.step}"
        )
    return None


def _outside_doubles(name: str, value: float, allowed: Any, tolerance: float) -> str | None:
    """The same for a double, with a relative tolerance at the ends and at each step."""
    ends = (allowed.from_value, allowed.to_value)
    low, high = min(ends), max(ends)  # NaN as the first end makes both NaN, as upstream
    if math.isclose(value, low, rel_tol=tolerance) or math.isclose(value, high, rel_tol=tolerance):
        return None
    if not low < value < high:
        return f"Parameter {name} out of range Min: {low}, Max: {high}, value: {value}"
    step = allowed.step
    if step and not math.isclose(low + round((value - low) / step) * step, value, rel_tol=tolerance):
        return (
            f"The parameter value for {name} is not close enough to a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {step}"
        )
    return None
