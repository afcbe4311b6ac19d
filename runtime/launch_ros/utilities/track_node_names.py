"""The node names that a launch has started, and how often it has started each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import launch.logging

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

KEY = "unique_ros_node_names"


def add_node_name(context: LaunchContext, node_name: str) -> None:
    """Count a name."""
    counts: dict[str, int] | None = context.get_locals_as_dict().get(KEY)
    if counts is None:
        counts = {}
        context.extend_globals({KEY: counts})
    counts[node_name] = counts.get(node_name, 0) + 1


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return how often a name was counted."""
    return context.get_locals_as_dict().get(KEY, {}).get(node_name, 0)


def warn_of_same_name(context: LaunchContext, node_name: str, origin: str) -> None:
    """Warn if a node will most likely have the same name as another, even if its namespace is not given."""
    names = context.names_without_namespace
    if node_name in names:
        launch.logging.get_logger("launch").warning(
            f"{origin}: this node and the one of {names[node_name]} have the same name {node_name}"
        )
    names[node_name] = origin
