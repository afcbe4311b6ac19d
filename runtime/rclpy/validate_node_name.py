"""Validation of node names."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy.exceptions import InvalidNodeNameException


def validate_node_name(node_name: str) -> bool:
    """True for a valid name; raises `InvalidNodeNameException`."""
    problem = names.validate_node_name(node_name)
    if problem:
        raise InvalidNodeNameException(node_name, *problem)
    return True
