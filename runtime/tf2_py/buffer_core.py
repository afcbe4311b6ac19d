"""Transforms of all frames over time, and the lookup between any two. Contract: upstream's `tf2_py`."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from geometry_msgs.msg import TransformStamped
from rclpy.constants import S_TO_NS
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.time import Time
from tf2_py import descriptions
from tf2_py.exceptions import InvalidArgumentException, LookupException, TransformException
from tf2_py.frame_history import DIGEST_AFTER, Entry, FrameHistory, Unread
from tf2_py.frame_tree import latest_common_time, transform
from tf2_py.rigid import IDENTITY, Rigid, compose

DEFAULT_CACHE_TIME = Duration(seconds=10)
NORM_TOLERANCE = 1e-2
"""How far the length of a rotation quaternion may be from 1."""
_EMPTY = TransformStamped()


class BufferCore:
    """Keeps transforms for `cache_time`; one thread may add them while others look them up.

    Times are `rclpy.time.Time`, or stamps of messages; time zero means the newest known. Lookups raise
    `LookupException`, `ConnectivityException`, `ExtrapolationException` and `InvalidArgumentException`.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        self._keep = (cache_time or DEFAULT_CACHE_TIME).nanoseconds
        self._histories: dict[str, FrameHistory] = {}
        self._parents: set[str] = set()

    def clear(self) -> None:
        """Forget all transforms that are not static."""
        self._histories = {name: each for name, each in self._histories.items() if each.is_static}

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform; an invalid one is ignored, and the log says why."""
        self._insert(transform, authority, is_static=False)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform that is valid at any time."""
        self._insert(transform, authority, is_static=True)

    def _take_later(self, messages: list[TransformStamped]) -> None:
        """Keep received messages unread; they are read when their frame is looked up."""
        histories = self._histories
        for each in messages:
            history = histories.get(each.child_frame_id)
            if history is None or history.is_static:
                self._insert(each, "default_authority", is_static=False)
                continue
            header, transform = each._header, each._transform  # bypassing the properties takes half the time
            stamp, move, turn = header._stamp, transform._translation, transform._rotation
            when = stamp._sec * S_TO_NS + stamp._nanosec
            waiting = history.waiting
            waiting.append((when, header._frame_id, move._x, move._y, move._z, turn._x, turn._y, turn._z, turn._w))
            if not len(waiting) % DIGEST_AFTER:
                history.drop_old()

    def _insert(self, message: TransformStamped, authority: str, *, is_static: bool) -> None:
        stamp = message.header.stamp
        move, turn = message.transform.translation, message.transform.rotation
        place = (move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w)
        entry = stamp.sec * S_TO_NS + stamp.nanosec, message.header.frame_id.removeprefix("/"), place, authority
        child = message.child_frame_id.removeprefix("/")
        if child in self._histories:
            self._histories[child].digest()  # read earlier ones first: of two with the same time the first counts
        self._keep_entry(child, entry, is_static)

    def _keep_entry(self, child: str, entry: Entry, is_static: bool) -> None:
        """Add a valid transform; for an invalid one the log says why not."""
        stamp, parent, place, authority = entry
        problem = _problem(child, parent, place, authority)
        if problem is None:
            history = self._histories.get(child)
            if history is None or history.is_static != is_static:
                read = partial(self._read, child)
                history = self._histories[child] = FrameHistory(self._keep, is_static, read)
            self._parents.add(parent)
            problem = history.insert(entry)
            if problem:
                when = f"at time {stamp / S_TO_NS:.6f} according to authority {authority}"
                problem += f" for frame {child} (parent {parent}) {when}"
        if problem:
            get_logger("tf2_buffer").warning(problem)

    def _read(self, child: str, unread: Unread) -> None:
        entry = unread[0], unread[1].removeprefix("/"), unread[2:], "default_authority"
        self._keep_entry(child, entry, is_static=False)

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Time) -> TransformStamped:
        """Return the transform that takes points of `source_frame` to `target_frame` at a time."""
        stamp, place = self._look_up(target_frame, source_frame, nanoseconds_of(time), "lookupTransform")
        return _message(target_frame, source_frame, stamp, place)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> TransformStamped:
        """Return the transform from `source_frame` at one time to `target_frame` at another, via a frame that is
        fixed.
        """
        self._check(fixed_frame, "lookupTransform argument fixed_frame")
        _, first = self._look_up(fixed_frame, source_frame, nanoseconds_of(source_time), "lookupTransform")
        stamp, second = self._look_up(target_frame, fixed_frame, nanoseconds_of(target_time), "lookupTransform")
        return _message(target_frame, source_frame, stamp, compose(second, first))

    def can_transform_core(self, target_frame: str, source_frame: str, time: Time) -> tuple[bool, str]:
        """Return whether `lookup_transform_core` would succeed, and why not."""
        try:
            self._look_up(target_frame, source_frame, nanoseconds_of(time), "canTransform")
        except TransformException as error:
            return False, str(error)
        return True, ""

    def can_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> tuple[bool, str]:
        """Return whether `lookup_transform_full_core` would succeed, and why not."""
        try:
            self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)
        except TransformException as error:
            return False, str(error)
        return True, ""

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the newest time at which the path between two frames is known."""
        self._check(target_frame, "getLatestCommonTime argument target_frame")
        self._check(source_frame, "getLatestCommonTime argument source_frame")
        return Time(nanoseconds=latest_common_time(self._histories.get, target_frame, source_frame))

    def all_frames_as_string(self) -> str:
        """Return all frames with their parents, one per line."""
        return descriptions.as_string(dict(self._histories))

    def all_frames_as_yaml(self) -> str:
        """Return all frames with parent, broadcaster, rate and times, as YAML."""
        return descriptions.as_yaml(dict(self._histories))

    def _frameExists(self, frame_id: str) -> bool:
        return frame_id in self._histories or frame_id in self._parents

    def _getFrameStrings(self) -> list[str]:
        return sorted({*self._histories, *self._parents})

    def _allFramesAsDot(self, current_time: float = 0.0) -> str:
        return descriptions.as_dot(dict(self._histories))

    def _check(self, frame: str, where: str) -> None:
        """Raise for an invalid or unknown frame name."""
        if not frame:
            raise InvalidArgumentException(
                f"Invalid argument passed to {where} in tf2 frame_ids cannot be empty",
            )
        if frame[0] == "/":
            raise InvalidArgumentException(
                f"Invalid argument \"{frame}\" passed to {where} in tf2 frame_ids cannot start with a '/'"
            )
        if frame not in self._histories and frame not in self._parents:
            raise LookupException(f'"{frame}" passed to {where} does not exist. ')

    def _look_up(self, target: str, source: str, time: int, what: str) -> tuple[int, Rigid]:
        """Return time (ns) and transform; `what` is the function named in an error message."""
        histories = self._histories
        if target not in histories:
            self._check(target, f"{what} argument target_frame")
        if source not in histories:
            self._check(source, f"{what} argument source_frame")
        find = histories.get
        if target == source:
            history = find(target)
            latest = None if history is None else history.latest()
            return time or (latest[0] if latest else 0), IDENTITY
        time = time or latest_common_time(find, target, source)
        return time, transform(find, target, source, time)


def nanoseconds_of(time: Any) -> int:
    """Return a time, or the stamp of a message, in ns; raises `TypeError` for anything else."""
    found = getattr(time, "nanoseconds", None)
    if found is not None:
        return found
    try:
        return time.sec * S_TO_NS + time.nanosec
    except AttributeError:
        raise TypeError("time must have sec and nanosec, or nanoseconds.") from None


def _problem(child: str, parent: str, place: Rigid, authority: str) -> str | None:
    if child == parent:
        return (
            f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and child_frame_id '
            f'"{child}" because they are the same'
        )
    if not child:
        return f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because child_frame_id not set '
    if not parent:
        return (
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}" from authority "{authority}" '
            "because frame_id not set"
        )
    if any(map(math.isnan, place)):
        return (
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}" because of '
            f"a nan value in the transform {place}"
        )
    norm = place[3] ** 2 + place[4] ** 2 + place[5] ** 2 + place[6] ** 2
    if abs(norm - 1.0) > NORM_TOLERANCE:
        return (
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of an invalid quaternion in the transform '
            f"({place[3]:f} {place[4]:f} {place[5]:f} {place[6]:f})"
        )
    return None


def _message(target: str, source: str, time: int, place: Rigid) -> TransformStamped:
    message = _EMPTY._copy_()  # takes less time than a new one
    header, transform = message._header, message._transform  # bypassing the properties takes half the time
    header._frame_id = target
    message._child_frame_id = source
    stamp = header._stamp
    stamp._sec, stamp._nanosec = divmod(time, S_TO_NS)
    move, turn = transform._translation, transform._rotation
    move._x, move._y, move._z, turn._x, turn._y, turn._z, turn._w = place
    return message
