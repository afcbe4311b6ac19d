"""Validation of full topic and service names."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy._rclpy_pybind11 import RMWError
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException


def validate_full_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True for a valid full name; raises `InvalidTopicNameException`, for services
    `InvalidServiceNameException`.
    """
    if name is None:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
        raise RMWError("failed to validate name: error not set")
    problem = names.validate_full_topic_name(name)
    if problem:
        raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *problem)
    return True
