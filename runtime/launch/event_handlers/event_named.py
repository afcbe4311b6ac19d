"""Matching events by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.event import Event


def event_named(name: str) -> Callable[[Event], bool]:
    """Return a predicate that tells whether an event has this name."""
    return lambda event: event.name == name
