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
    """The entity being visited; None while a file is read."""


def report_place(
    error: BaseException, file: str, line: int | None = None, entity: LaunchDescriptionEntity | None = None
) -> None:
    """Attach the place where it was raised to an exception; an earlier place, nearer to the origin, is kept."""
    # not `setattr`, as a user's exception may be a frozen dataclass
    error.__dict__.setdefault(ATTRIBUTE, LaunchPlace(file, line, entity))


def report_visited(error: BaseException, entity: LaunchDescriptionEntity) -> None:
    """Attach the entity whose visit raised it to an exception, and the entity's origin if known."""
    origin = str(getattr(entity, "origin", ""))
    file, _, line = origin.rpartition(":")
    if line.isdigit():
        report_place(error, file, int(line), entity)
    else:
        report_place(error, origin, entity=entity)
