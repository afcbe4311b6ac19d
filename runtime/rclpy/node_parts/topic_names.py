"""Topic and service names as a node uses them: expanded, remapped and validated."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.rmw import names, remapping
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.validate_full_topic_name import validate_full_topic_name

if TYPE_CHECKING:
    from rclpy.node_parts.base import NodeBase


def checked_name(node: NodeBase, name: str, *, service: bool = False) -> str:
    """Return the full, remapped name of an entity to be created.

    Raises `InvalidTopicNameException` or `InvalidServiceNameException`, and `ValueError` for an unknown substitution.
    """
    kind = InvalidServiceNameException if service else InvalidTopicNameException
    if name is None and not service:  # pyright: ignore[reportUnnecessaryComparison] -- a user's argument
        raise RCLError("failed to validate name: topic_name argument is null")
    problem = names.validate_topic_name(name)
    if problem:
        raise kind(name, *problem)
    full = remapped_name(node, expand_topic_name(name, node.get_name(), node.get_namespace()), service)
    validate_full_topic_name(full, is_service=service)
    return full


def expand_name(node: NodeBase, name: str, *, service: bool = False) -> str:
    """Return the full name of an existing topic or service, not remapped.

    Raises `ValueError` as upstream's `count_...` methods do, and what `checked_name` raises for invalid full names.
    """
    full = expand_topic_name(name, node.get_name(), node.get_namespace())
    validate_full_topic_name(full, is_service=service)
    return full


def resolve(node: NodeBase, name: str, *, only_expand: bool, service: bool = False) -> str:
    """Return the full name, remapped unless only expansion is requested; raises `RCLError`."""
    problem = names.validate_topic_name(name)
    if problem:
        raise RCLError(f"failed to resolve name: {problem[0]}")
    try:
        full = names.expand(name, node.get_name(), node.get_namespace())
    except ValueError as error:
        raise RCLError(f"failed to resolve name: {error}") from None
    full = full if only_expand else remapped_name(node, full, service)
    problem = names.validate_full_topic_name(full)
    if problem:
        raise RCLError(f"failed to resolve name: {problem[0]}")
    return full


def remapped_name(node: NodeBase, full: str, service: bool = False) -> str:
    """Return a full name to which the node's remap rules have been applied."""
    rules = node._ros_remap_rules
    if not rules:
        return full
    remap = remapping.remap_service if service else remapping.remap_topic
    return remap(rules, node.get_name(), node.get_namespace(), full)
