"""Validation of node names."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy._rclpy_pybind11 import RMWError
from rclpy.exceptions import InvalidNodeNameException


def validate_node_name(node_name: str) -> bool:
    """Return True for a valid name; raises `InvalidNodeNameException`."""
    if node_name is None:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
        raise RMWError("failed to validate node name: error not set")
    problem = names.validate_node_name(node_name)
    if problem:
        raise InvalidNodeNameException(node_name, *problem)
    return True
