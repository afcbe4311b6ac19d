"""The full name of a node, as the graph gives it: in two parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.topic_endpoint_info import TopicEndpointInfo


def full_name(namespace: str, name: str) -> str:
    """A node's name with its namespace before it."""
    return f"{namespace.rstrip('/')}/{name}"


def name_of(endpoint: TopicEndpointInfo) -> str:
    """That of the node of an endpoint."""
    return full_name(endpoint.node_namespace, endpoint.node_name)
