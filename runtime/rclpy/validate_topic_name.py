"""Validation of topic and service names before expansion."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException

TOPIC_SEPARATOR_STRING = "/"


def validate_topic_name(name: str, *, is_service: bool = False) -> bool:
    """Return True for a valid name; raises `InvalidTopicNameException`, for services `InvalidServiceNameException`."""
    if name is None:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
        raise RCLError("failed to validate name: topic_name argument is null")
    problem = names.validate_topic_name(name)
    if problem:
        raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *problem)
    return True
