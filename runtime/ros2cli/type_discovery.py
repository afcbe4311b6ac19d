"""Types that are unknown here: requested from the nodes that use them, and verified against the hashes in the graph."""

from __future__ import annotations

import argparse
import importlib.util
import re
from collections.abc import Callable
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

from bot_console.runtime.interfaces.learned_interfaces import TYPE_NAME, learned_folders
from rosidl_runtime_py.utilities import get_message

if TYPE_CHECKING:
    from rclpy.node import Node

DESCRIPTION_TIMEOUT_S = 2.0
"""Time (s) that a node may take to describe a type."""
MISSING = (ValueError, AttributeError, ModuleNotFoundError)


def message_class(node: Node, topic: str, type_name: str) -> Any:
    """Return the message class of a topic, or the reason why it is not available as a string."""
    try:
        return get_message(type_name)
    except MISSING:
        pass
    why = _learn_from_nodes(node, type_name)
    if why == "":
        return get_message(type_name)
    why = "no node publishes it that could be asked" if why is None else why
    return f"The type '{type_name}' of topic '{topic}' is not installed here: {why}"


def class_of_typed_name(
    get: Callable[[str], Any], kind: str, type_name: str, invalid: str, node: Node | None = None
) -> Any:
    """Return the class of a type as typed by a user, with or without `kind` (msg, srv, action) in the middle of its
    name.

    `get` finds installed types; otherwise `node`, or a temporary node, asks the nodes that use the type. If there is no
    class, returns a string: `invalid` if no node uses the type either, else why it could not be learned.
    """
    try:
        return get(type_name)
    except MISSING:
        pass
    full = full_type_name(kind, type_name)
    why = learn_type(full, node) if f"/{kind}/" in full else None
    if why is None:
        return invalid
    return not_installed(full, why) if why else get(full)


def not_installed(type_name: str, why: str) -> str:
    """Return the message for a type that could not be learned."""
    return f"The type '{type_name}' is not installed here: {why}"


def learn_type(type_name: str, node: Node | None = None) -> str | None:
    """Learn a type by its full name; returns an empty string, or why that failed, or None if no node knows the type."""
    package = type_name.partition("/")[0]
    if not re.fullmatch(TYPE_NAME, type_name):
        return None
    if package not in learned_folders() and importlib.util.find_spec(package) is not None:
        return None
    from ros2cli.direct_node import DirectNode

    with nullcontext(node) if node else DirectNode(argparse.Namespace(no_daemon=True)) as asking:
        return _learn_from_nodes(asking, type_name)


def full_type_name(kind: str, type_name: str) -> str:
    """Return `pkg/<kind>/Name` for `pkg/Name`; any other name unchanged."""
    package, slash, name = type_name.partition("/")
    return f"{package}/{kind}/{name}" if slash and "/" not in name else type_name


def _learn_from_nodes(node: Node, type_name: str) -> str | None:
    """Learn a type, and an action's parts; returns "", why it failed, or None if no node knows it."""
    from bot_console.runtime.interfaces.type_inquiry import containing_action, inquiries

    why = None
    for name, inquiry in inquiries(node.context.get_domain_id(), containing_action(type_name)).items():
        problem = _ask_node(node, name, inquiry)
        if not problem:
            return ""
        why = f"{name} {problem}"
    return why


def _ask_node(node: Node, name: str, inquiry: Any) -> str:
    """Ask a node all questions of an inquiry; returns why that failed, or an empty string."""
    from ros2cli.direct_node import spin_until
    from type_description_interfaces.srv import GetTypeDescription

    client = node.create_client(GetTypeDescription, f"{name}/get_type_description")
    try:
        spin_until(node, client.service_is_ready, DESCRIPTION_TIMEOUT_S)
        type_name, type_hash = next(inquiry)
        while True:
            request = GetTypeDescription.Request(type_name=type_name, type_hash=type_hash, include_type_sources=True)
            future = client.call_async(request)
            if not spin_until(node, future.done, DESCRIPTION_TIMEOUT_S):
                return f"has not described it within {DESCRIPTION_TIMEOUT_S:g} s"
            type_name, type_hash = inquiry.send(future.result())
    except StopIteration as over:
        return over.value
    finally:
        node.destroy_client(client)
