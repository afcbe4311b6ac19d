"""Predicates over actions that run nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.action import Action


def matches_node_name(node_name: str) -> Callable[[Action], bool]:
    """Return a predicate that tells whether an action's node has this full name."""
    name = node_name if node_name.startswith("/") else f"/{node_name}"
    return lambda action: getattr(action, "node_name", None) == name
