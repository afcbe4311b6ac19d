"""Names of topics and services as a node uses them: expanded, remapped, checked."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.rmw import names, remapping
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException


def checked(node: Any, name: str, *, service: bool = False) -> str:
    """The full, remapped name of an entity to be made.

    Raises `InvalidTopicNameException` or `InvalidServiceNameException`, and `ValueError` for an unknown substitution.
    """
    kind = InvalidServiceNameException if service else InvalidTopicNameException
    problem = names.validate_topic_name(name)
    if problem:
        raise kind(name, *problem)
    full = _remapped(node, names.expand(name, node.get_name(), node.get_namespace()), service)
    problem = names.validate_full_topic_name(full)
    if problem:
        raise kind(full, *problem)
    return full


def expand_name(node: Any, name: str, *, service: bool = False) -> str:
    """The full name of an existing topic or service, not remapped; raises `ValueError` as upstream's counts do."""
    problem = names.validate_topic_name(name)
    if problem:
        raise ValueError(f"topic name '{name}' is invalid: {problem[0]}")
    return names.expand(name, node.get_name(), node.get_namespace())


def resolve(node: Any, name: str, *, only_expand: bool, service: bool = False) -> str:
    """The full name, remapped unless told otherwise; raises `RCLError`."""
    problem = names.validate_topic_name(name)
    if problem:
        raise RCLError(f"failed to resolve name: {problem[0]}")
    try:
        full = names.expand(name, node.get_name(), node.get_namespace())
    except ValueError as error:
        raise RCLError(f"failed to resolve name: {error}") from None
    full = full if only_expand else _remapped(node, full, service)
    problem = names.validate_full_topic_name(full)
    if problem:
        raise RCLError(f"failed to resolve name: {problem[0]}")
    return full


def _remapped(node: Any, full: str, service: bool) -> str:
    rules = node._remap_rules
    if not rules:
        return full
    remap = remapping.remap_service if service else remapping.remap_topic
    return remap(rules, node.get_name(), node.get_namespace(), full)
