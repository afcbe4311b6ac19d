"""The actions in the graph, recognised by their feedback topics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError

if TYPE_CHECKING:
    from rclpy.node import Node

NamesAndTypes = list[tuple[str, list[str]]]

TOPIC_SUFFIX = "/_action/feedback"
TYPE_SUFFIX = "_FeedbackMessage"


def _actions(topics: NamesAndTypes) -> NamesAndTypes:
    found: NamesAndTypes = []
    for topic, types in topics:
        if topic.endswith(TOPIC_SUFFIX):
            kinds = [each.removesuffix(TYPE_SUFFIX) for each in types if each.endswith(TYPE_SUFFIX)]
            found.append((topic.removesuffix(TOPIC_SUFFIX), kinds))
    return found


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions that a node calls; raises `RCLError` for an unknown node."""
    try:
        return _actions(node.get_subscriber_names_and_types_by_node(remote_node_name, remote_node_namespace))
    except NodeNameNonExistentError as error:
        raise RCLError(f"Failed to get action client names and type: {error}") from None


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions that a node serves; raises `RCLError` for an unknown node."""
    try:
        return _actions(node.get_publisher_names_and_types_by_node(remote_node_name, remote_node_namespace))
    except NodeNameNonExistentError as error:
        raise RCLError(f"Failed to get action server names and type: {error}") from None


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """Return all actions with their types, by name."""
    return _actions(node.get_topic_names_and_types())
