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
from tf2_py.frame_tree import LOOP, LoopError, latest_common_time, transform
from tf2_py.rigid import IDENTITY, Rigid, compose, unit_quaternion

DEFAULT_CACHE_TIME = Duration(seconds=10)
NORM_TOLERANCE = 1e-2
"""How much the length of a rotation quaternion may differ from 1."""
OLD_DATA = (
    "TF_OLD_DATA ignoring data from the past for frame {child} at time {time:.6f} according to authority {authority}\n"
    "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained"
)
_EMPTY = TransformStamped()


class BufferCore:
    """Keeps transforms for `cache_time`; one thread may add them while others look them up.

    Times are `rclpy.time.Time`, or stamps of messages; time zero means the newest known. Lookups raise
    `LookupException`, `ConnectivityException`, `ExtrapolationException` and `InvalidArgumentException`.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        self._keep = (cache_time or DEFAULT_CACHE_TIME).nanoseconds
        self._histories: dict[str, FrameHistory] = {}
        self._names: dict[str, None] = {}  # all frames, in the order in which they became known

    def clear(self) -> None:
        """Forget all transforms that are not static; their frames remain known."""
        for each in list(self._histories.values()):
            each.clear()

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform; an invalid one is ignored, and logged with the reason."""
        self._insert(transform, authority, is_static=False)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform that is valid at any time."""
        self._insert(transform, authority, is_static=True)

    def _take_later(self, messages: list[TransformStamped]) -> None:
        """Keep received messages unread until their frames are looked up."""
        histories = self._histories
        for each in messages:
            history = histories.get(each.child_frame_id)
            if history is None or history.is_static:
                self._insert(each, "default_authority", is_static=False)
                continue
            header, transform = each._header, each._transform  # bypassing the properties halves the time
            stamp, move, turn = header._stamp, transform._translation, transform._rotation
            when = stamp._sec * S_TO_NS + stamp._nanosec
            waiting = history.waiting
            waiting.append((when, header._frame_id, move._x, move._y, move._z, turn._x, turn._y, turn._z, turn._w))
            if not len(waiting) % DIGEST_AFTER:
                history.drop_old()

    def _insert(self, message: TransformStamped, authority: str, *, is_static: bool) -> None:
        stamp = message.header.stamp
        move, turn = message.transform.translation, message.transform.rotation
        # As floats: tf_transformations returns numpy's numbers.
        x, y, z = float(move.x), float(move.y), float(move.z)
        place = (x, y, z, float(turn.x), float(turn.y), float(turn.z), float(turn.w))
        entry = stamp.sec * S_TO_NS + stamp.nanosec, message.header.frame_id.removeprefix("/"), place, authority
        child = message.child_frame_id.removeprefix("/")
        if child in self._histories:
            self._histories[child].digest()  # read earlier ones first: of two with the same time, the first counts
        self._keep_entry(child, entry, is_static)

    def _keep_entry(self, child: str, entry: Entry, is_static: bool) -> None:
        """Add a valid transform; an invalid one is logged with the reason."""
        stamp, parent, place, authority = entry
        problem = _problem(child, parent, place, authority)
        if problem is None:
            history = self._histories.get(child)
            if history is None or history.is_static != is_static:
                read = partial(self._read, child)
                history = self._histories[child] = FrameHistory(self._keep, is_static, read)
            self._names.setdefault(child)
            self._names.setdefault(parent)
            if not history.insert(entry):
                problem = OLD_DATA.format(child=child, time=stamp / S_TO_NS, authority=authority)
        if problem:
            get_logger("tf2_buffer").warning(problem)

    def _read(self, child: str, unread: Unread) -> None:
        entry = unread[0], unread[1].removeprefix("/"), unread[2:], "default_authority"
        self._keep_entry(child, entry, is_static=False)

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Time) -> TransformStamped:
        """Return the transform that maps points from `source_frame` to `target_frame` at a time."""
        stamp, place = self._look_up(target_frame, source_frame, nanoseconds_of(time))
        return _message(target_frame, source_frame, stamp, place)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> TransformStamped:
        """Return the transform from `source_frame` at one time to `target_frame` at another, via a fixed frame."""
        self._check(target_frame, "lookupTransform argument target_frame")
        self._check(source_frame, "lookupTransform argument source_frame")
        self._check(fixed_frame, "lookupTransform argument fixed_frame")
        _, first = self._look_up(fixed_frame, source_frame, nanoseconds_of(source_time))
        stamp, second = self._look_up(target_frame, fixed_frame, nanoseconds_of(target_time))
        return _message(target_frame, source_frame, stamp, compose(second, first))

    def can_transform_core(self, target_frame: str, source_frame: str, time: Time) -> tuple[int, str]:
        """Return 1 if `lookup_transform_core` would succeed, or 0 and the reason why not."""
        stamp = nanoseconds_of(time)
        if target_frame == source_frame:
            return 1, ""
        return self._possible({"target": target_frame, "source": source_frame}, (target_frame, source_frame, stamp))

    def can_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> tuple[int, str]:
        """Return 1 if `lookup_transform_full_core` would succeed, or 0 and the reason why not."""
        frames = {"target": target_frame, "source": source_frame, "fixed": fixed_frame}
        to_target = target_frame, fixed_frame, nanoseconds_of(target_time)
        return self._possible(frames, to_target, (fixed_frame, source_frame, nanoseconds_of(source_time)))

    def _possible(self, frames: dict[str, str], *lookups: tuple[str, str, int]) -> tuple[int, str]:
        """Check frames by their roles, then lookups; upstream returns 1 and 0 where a truth value is expected."""
        for role, frame in frames.items():
            if problem := self._flaw(frame):
                return 0, f'Invalid frame ID "{frame}" passed to canTransform argument {role}_frame - {problem}'
        try:
            for each in lookups:
                self._look_up(*each)
        except TransformException as error:
            return 0, str(error)
        return 1, ""

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the newest time at which the path between two frames is known."""
        self._check(target_frame, "get_latest_common_time")
        self._check(source_frame, "get_latest_common_time")
        if target_frame == source_frame:
            return Time(nanoseconds=self._latest(target_frame))
        try:
            return Time(nanoseconds=latest_common_time(self._histories.get, target_frame, source_frame))
        except TransformException as error:
            raise TransformException(str(error)) from None  # upstream's exception has no particular class

    def all_frames_as_string(self) -> str:
        """Return all frames with their parents, one per line."""
        return descriptions.as_string(self._in_order())

    def all_frames_as_yaml(self) -> str:
        """Return all frames with parent, broadcaster, rate and times as YAML."""
        return descriptions.as_yaml(self._in_order())

    def _in_order(self) -> dict[str, FrameHistory]:
        histories = dict(self._histories)
        return {name: histories[name] for name in list(self._names) if name in histories}

    def _frameExists(self, frame_id: str) -> bool:
        return frame_id in self._names

    def _getFrameStrings(self) -> list[str]:
        return list(self._names)

    def _allFramesAsDot(self, time: object = None) -> str:
        now = 0 if time is None else nanoseconds_of(time)
        return descriptions.as_dot(self._in_order(), list(self._names), now)

    def _flaw(self, frame: str) -> str:
        """Return what is wrong with a frame's name, in upstream's words; empty for a known frame."""
        if not frame:
            return "in tf2 frame_ids cannot be empty"
        if frame[0] == "/":
            return "in tf2 frame_ids cannot start with a '/'"
        return "" if frame in self._names else "frame does not exist"

    def _check(self, frame: str, where: str) -> None:
        """Raise an exception for an invalid or unknown frame name."""
        problem = self._flaw(frame)
        if problem.startswith("in"):
            raise InvalidArgumentException(f'Invalid argument "{frame}" passed to {where} - {problem}')
        if problem:
            raise LookupException(f'"{frame}" passed to {where} does not exist. ')

    def _latest(self, frame: str) -> int:
        """Return the time (ns) of a frame's newest transform; 0 if it has none or a static one."""
        history = self._histories.get(frame)
        latest = None if history is None else history.latest()
        return latest[0] if latest else 0

    def _look_up(self, target: str, source: str, time: int) -> tuple[int, Rigid]:
        """Return time (ns) and transform; a frame need not be known for a lookup relative to itself."""
        if target == source:
            return time or self._latest(target), IDENTITY
        histories = self._histories
        if target not in histories:
            self._check(target, "lookupTransform argument target_frame")
        if source not in histories:
            self._check(source, "lookupTransform argument source_frame")
        try:
            time = time or latest_common_time(histories.get, target, source)
            return time, transform(histories.get, target, source, time)
        except LoopError:
            raise LookupException(f"{LOOP}\n{self.all_frames_as_string()}\n") from None


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
    message = _EMPTY._copy_()  # faster than creating a new one
    header, transform = message._header, message._transform  # bypassing the properties halves the time
    header._frame_id = target
    message._child_frame_id = source
    stamp = header._stamp
    stamp._sec, stamp._nanosec = divmod(time, S_TO_NS)
    move, turn = transform._translation, transform._rotation
    move._x, move._y, move._z = place[:3]
    turn._x, turn._y, turn._z, turn._w = unit_quaternion(*place[3:])
    return message
