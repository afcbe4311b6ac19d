"""Types of topics that nobody here has: asked from the nodes that publish them, and held against their hashes."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.rmw.names import full_name
from rclpy.node import Node
from ros2cli.direct_node import spin_until
from rosidl_runtime_py.utilities import get_message

PATIENCE = 2.0
"""Seconds that a node may take to describe a type."""
MISSING = (ValueError, AttributeError, ModuleNotFoundError)


def message_class(node: Node, topic: str, type_name: str) -> Any:
    """The class of a topic's messages, or a text that says why there is none."""
    try:
        return get_message(type_name)
    except MISSING:
        pass
    why = "no node publishes it that could be asked"
    for endpoint in node.get_publishers_info_by_topic(topic):
        found = _asked(node, endpoint, type_name)
        if not isinstance(found, str):
            return found
        why = found
    return f"The type '{type_name}' of topic '{topic}' is not installed here: {why}"


def _asked(node: Node, endpoint: Any, type_name: str) -> Any:
    """The class that an endpoint's node describes, or why it is none."""
    from bot_console.runtime.learned_interfaces import learn
    from type_description_interfaces.srv import GetTypeDescription

    name = full_name(endpoint.node_namespace, endpoint.node_name)
    wanted = str(endpoint.topic_type_hash)
    client = node.create_client(GetTypeDescription, f"{name}/get_type_description")
    try:
        spin_until(node, client.service_is_ready, PATIENCE)
        request = GetTypeDescription.Request(type_name=type_name, type_hash=wanted, include_type_sources=True)
        future = client.call_async(request)
        if not spin_until(node, future.done, PATIENCE):
            return f"{name} has not described it within {PATIENCE:g} s"
        told = future.result()
    finally:
        node.destroy_client(client)
    problem = learn(type_name, wanted, told)
    return f"{name} {problem}" if problem else get_message(type_name)
