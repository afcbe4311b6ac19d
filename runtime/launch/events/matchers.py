"""Predicates over events."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def matches_action(target_action: Any) -> Callable[[Any], bool]:
    """Return a predicate: whether an action is this one."""

    def matches(action: Any) -> bool:
        return action is target_action

    return matches
