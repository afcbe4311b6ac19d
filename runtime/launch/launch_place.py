"""Where in the launch files an exception was raised, noted on the exception itself (not upstream)."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity

ATTRIBUTE = "launch_place"
"""The attribute of an exception that holds its `LaunchPlace`, if known."""


class LaunchPlace(NamedTuple):
    """The place in a launch file that was being read or visited when an exception was raised."""

    file: str
    """The launch file; empty if unknown."""
    line: int | None
    """Its line, from 1; None if unknown."""
    entity: LaunchDescriptionEntity | None
    """The entity being visited; None while reading a file."""


def report_place(
    error: BaseException, file: str, line: int | None = None, entity: LaunchDescriptionEntity | None = None
) -> None:
    """Attach to an exception where it was raised; a place attached earlier, nearer to its origin, is kept."""
    # not setattr: a user's exception may be a frozen dataclass
    error.__dict__.setdefault(ATTRIBUTE, LaunchPlace(file, line, entity))


def report_visited(error: BaseException, entity: LaunchDescriptionEntity) -> None:
    """Attach to an exception the entity whose visit raised it, and the entity's origin if known."""
    origin = str(getattr(entity, "origin", ""))
    file, _, line = origin.rpartition(":")
    if line.isdigit():
        report_place(error, file, int(line), entity)
    else:
        report_place(error, origin, entity=entity)
