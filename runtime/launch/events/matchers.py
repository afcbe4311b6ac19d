"""Predicates over events."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def matches_action(target_action: object) -> Callable[[Any], bool]:
    """Return a predicate that tells whether an action is this one."""

    def matches(action: object) -> bool:
        return action is target_action

    return matches
