"""Where in the launch files an exception was raised, noted on the exception itself (not upstream)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

ATTRIBUTE = "launch_place"
"""The attribute of an exception that holds its `LaunchPlace`, where launch has told one."""


@dataclass(frozen=True)
class LaunchPlace:
    """What was being read or visited when an exception was raised."""

    file: str
    """The launch file; empty where it is not known."""
    line: int | None
    """The line in it, from 1; None where it is not known."""
    entity: Any
    """What was being visited; None while a file was read."""


def tell_place(error: BaseException, file: str, line: int | None = None, entity: Any = None) -> None:
    """Attach to an exception where it was raised; what was told nearer to its origin stays."""
    # not setattr: an exception of the user's may be a frozen dataclass
    error.__dict__.setdefault(ATTRIBUTE, LaunchPlace(file, line, entity))


def tell_visited(error: BaseException, entity: Any) -> None:
    """Attach to an exception that it was raised by visiting an entity, and where that was made if it says so."""
    origin = str(getattr(entity, "origin", ""))
    file, _, line = origin.rpartition(":")
    if line.isdigit():
        tell_place(error, file, int(line), entity)
    else:
        tell_place(error, origin, entity=entity)
