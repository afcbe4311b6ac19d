"""The ids of what is drawn: a node by its name, and what stands between nodes with its kind in front. Pure."""

from __future__ import annotations

TOPIC, SERVICE, ACTION = "topic:", "service:", "action:"
LINKS = (TOPIC, SERVICE, ACTION)
"""How the ids of items begin that stand between nodes."""


def is_link(item: str) -> bool:
    """Whether an item links nodes: a topic, a service, an action."""
    return item.startswith(LINKS)
