"""Predicates over actions that run processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def matches_pid(pid: int) -> Callable[[Any], bool]:
    """A predicate: whether an action's process has this number."""
    return lambda action: (action.process_details or {}).get("pid") == pid


def matches_name(name: str) -> Callable[[Any], bool]:
    """A predicate: whether an action's process has this label."""
    return lambda action: (action.process_details or {}).get("name") == name


def matches_executable(executable: str) -> Callable[[Any], bool]:
    """A predicate: whether an action's command begins with this program."""
    return lambda action: ((action.process_details or {}).get("cmd") or [None])[0] == executable
