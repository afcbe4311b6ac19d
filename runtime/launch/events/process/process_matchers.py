"""Predicates over actions that run processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def matches_pid(pid: int) -> Callable[[Any], bool]:
    """Return a predicate that tells whether an action's process has this pid."""
    return lambda action: _details(action).get("pid") == pid


def matches_name(name: str) -> Callable[[Any], bool]:
    """Return a predicate that tells whether an action's process has this label."""
    return lambda action: _details(action).get("name") == name


def matches_executable(executable: str) -> Callable[[Any], bool]:
    """Return a predicate that tells whether an action's command begins with this program."""
    return lambda action: (_details(action).get("cmd") or [None])[0] == executable


def _details(action: Any) -> dict[str, Any]:
    return action.process_details or {}
