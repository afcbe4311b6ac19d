"""Validation of parameter names."""

from __future__ import annotations

from rclpy.exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> bool:
    """Return True for a valid name; raises `InvalidParameterException` for an empty one, the only invalid kind."""
    if not name:
        raise InvalidParameterException(name)
    return True
