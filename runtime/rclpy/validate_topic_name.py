"""Validation of topic and service names as typed."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException

TOPIC_SEPARATOR_STRING = "/"


def validate_topic_name(name: str, *, is_service: bool = False) -> bool:
    """True for a valid name; raises `InvalidTopicNameException`, for services `InvalidServiceNameException`."""
    problem = names.validate_topic_name(name)
    if problem:
        raise (InvalidServiceNameException if is_service else InvalidTopicNameException)(name, *problem)
    return True
