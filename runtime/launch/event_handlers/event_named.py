"""Matching events by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def event_named(name: str) -> Callable[[Any], bool]:
    """Return a predicate: whether an event has this name."""
    return lambda event: event.name == name
