"""The fully qualified name of a node, which the graph gives in two parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.topic_endpoint_info import TopicEndpointInfo


def full_node_name(namespace: str, name: str) -> str:
    """A node's name, prefixed with its namespace."""
    return f"{namespace.rstrip('/')}/{name}"


def node_name_of(endpoint: TopicEndpointInfo) -> str:
    """The fully qualified name of an endpoint's node."""
    return full_node_name(endpoint.node_namespace, endpoint.node_name)
