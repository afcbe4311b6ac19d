"""The fully qualified name of a node, which the graph provides in two parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.topic_endpoint_info import TopicEndpointInfo


def full_node_name(namespace: str, name: str) -> str:
    """Join the namespace and the name of a node."""
    return f"{namespace.rstrip('/')}/{name}"


def node_name_of(endpoint: TopicEndpointInfo) -> str:
    """The fully qualified name of an endpoint's node."""
    return full_node_name(endpoint.node_namespace, endpoint.node_name)
