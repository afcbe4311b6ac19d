"""Expansion of topic names."""

from __future__ import annotations

from bot_console.runtime.rmw import names
from rclpy._rclpy_pybind11 import RCLError


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Return the full name of a topic as seen by a node; raises `ValueError` if any of the three names is invalid."""
    if topic_name is None:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
        raise RCLError("failed to do name expansion: input_topic_name argument is null")
    problem = names.validate_topic_name(topic_name)
    if problem:
        raise ValueError(f"topic name '{topic_name}' is invalid: {problem[0]}")
    problem = names.validate_node_name(node_name)
    if problem:
        raise ValueError(f"node name '{node_name}' is invalid: {problem[0]}")
    problem = names.validate_namespace(node_namespace)
    if problem:
        raise ValueError(f"node namespace '{node_namespace}' is invalid: {problem[0]}")
    try:
        return names.expand(topic_name, node_name, node_namespace)
    except ValueError as error:
        raise ValueError(f"topic name '{topic_name}' is invalid: {error}") from None
