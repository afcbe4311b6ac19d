"""Where in the launch files an exception was raised, noted on the exception itself (not upstream)."""

from __future__ import annotations

import traceback
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


def place_of(error: BaseException) -> str:
    """Return `FILE:LINE`, or `FILE`, of the innermost place on an exception and its causes; empty if none is known."""
    cause: BaseException | None = error
    found = ""
    while cause is not None:
        place: LaunchPlace | None = getattr(cause, ATTRIBUTE, None)
        if place is not None and place.file:
            line = _line_in(place.file, cause) or place.line
            found = f"{place.file}:{line}" if line else place.file
        cause = cause.__cause__
    return found


def _line_in(file: str, error: BaseException) -> int | None:
    """Return the line of a Python launch file at which an exception was raised; None if it was raised elsewhere."""
    if isinstance(error, SyntaxError) and error.filename == file:
        return error.lineno
    frames = traceback.walk_tb(error.__traceback__)
    return next((line for frame, line in reversed(list(frames)) if frame.f_code.co_filename == file), None)
