"""The names that the graph leaves out unless it is asked for them: tools' topics, hidden names, nodes' own services."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase

from bot_console.tui.console.model import NodeInfo

TOOL_NAMES = ("/rosout", "/parameter_events", "/statistics", "/rosout_agg", "/diagnostics_agg")
"""Topics that every node or many tools use; they would clutter the graph."""


def is_hidden(name: str, patterns: Iterable[str]) -> bool:
    """Whether a node or a topic is hidden: by a pattern, or because part of its name begins with an underscore, as in
    ROS.
    """
    return "/_" in name or any(fnmatchcase(name, each) for each in patterns)


def is_own_service(service: str, nodes: Iterable[NodeInfo]) -> bool:
    """Whether a service belongs to its node alone, such as the parameter services, and has no client."""
    nodes = list(nodes)
    return any(service.startswith(f"{node.name}/") for node in nodes) and not any(
        each.name == service for node in nodes for each in node.clients
    )
