"""The path from one frame to another: up to their common ancestor, and down again."""

from __future__ import annotations

from collections.abc import Callable

from tf2_py.exceptions import ConnectivityException, ExtrapolationException, LookupException
from tf2_py.frame_history import FrameHistory
from tf2_py.rigid import IDENTITY, Rigid, compose, inverse

MAX_DEPTH = 1000
"""How many frames may be between a frame and the root of its tree; more count as a loop."""
LOOP = "The tf tree is invalid because it contains a loop."


class LoopError(LookupException):
    """The frames form a loop."""


Find = Callable[[str], FrameHistory | None]
"""Returns the history of a frame; None if it is not the child of any frame."""


def transform(find: Find, target: str, source: str, time: int) -> Rigid:
    """Return the transform that maps points from `source` to `target` at a time (ns; 0 means the newest).

    Raises `ConnectivityException`, `ExtrapolationException` and, for a loop, `LookupException`.
    """
    above: dict[str, Rigid] = {source: IDENTITY}
    problem: str | None = None
    frame, place = source, IDENTITY
    while frame != target and (history := find(frame)) is not None:
        try:
            frame, step = history.at(time)
        except LookupError as error:
            problem = str(error)
            break
        if frame in above:
            raise LoopError(LOOP)
        above[frame] = place = step if place is IDENTITY else compose(step, place)
    if frame == target:
        return place
    return _descend(find, above, target, source, time, problem)


def _descend(find: Find, above: dict[str, Rigid], target: str, source: str, time: int, problem: str | None) -> Rigid:
    frame, place = target, IDENTITY
    for _ in range(MAX_DEPTH):
        if frame in above:
            return compose(inverse(place), above[frame])
        history = find(frame)
        if history is None and problem is None:
            raise ConnectivityException(unconnected_message(target, source))
        try:
            if history is None:
                raise LookupError(problem or "")
            frame, step = history.at(time)
        except LookupError as error:
            words = f"{error}, when looking up transform from frame [{source}] to frame [{target}]"
            raise ExtrapolationException(words) from None
        place = step if place is IDENTITY else compose(step, place)
    raise LoopError(LOOP)


def latest_common_time(find: Find, target: str, source: str) -> int:
    """Return the newest time (ns) at which all frames between the two are known; 0 if all are static.

    Raises `ConnectivityException`, or `LookupException` for a loop.
    """
    above = _ancestors(find, source, target)
    if target in above:
        return above[target]
    newest = 0
    frame = target
    for _ in range(MAX_DEPTH):
        history = find(frame)
        latest = None if history is None else history.latest()
        if latest is None:
            raise ConnectivityException(unconnected_message(target, source))
        newest = _earlier_time(newest, latest[0])
        frame = latest[1]
        if frame in above:
            return _earlier_time(newest, above[frame])
    raise LoopError(LOOP)


def _ancestors(find: Find, frame: str, up_to: str) -> dict[str, int]:
    """Return the frames above a frame, up to another, each with the newest time at which the path to it is known."""
    newest = 0
    above = {frame: 0}
    while frame != up_to and (history := find(frame)) is not None and (latest := history.latest()) is not None:
        time, frame = latest
        if frame in above:
            raise LoopError(LOOP)
        above[frame] = newest = _earlier_time(newest, time)
    return above


def _earlier_time(one: int, other: int) -> int:
    if one and other:
        return one if one < other else other
    return one or other


def unconnected_message(target: str, source: str) -> str:
    """Return the error message for two frames in different trees."""
    return (
        f"Could not find a connection between '{target}' and '{source}' because they are not part of the same tree."
        "Tf has two or more unconnected trees."
    )
