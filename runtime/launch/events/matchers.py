"""Predicates over events."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.action import Action


def matches_action(target_action: object) -> Callable[[Action], bool]:
    """Return a predicate: whether an action is this one."""

    def matches(action: object) -> bool:
        return action is target_action

    return matches
