"""The motion that a goal requires of the robot, one control step at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bot_console_robot.navigation.path_following import (
    Limits,
    PathFollower,
    Point,
    Pose,
    Velocity,
    heading_error,
    turn_in_place,
)

STUCK_AFTER_S = 10.0
"""Seconds without progress after which a goal is aborted."""
MIN_PROGRESS = 0.1
"""Minimum distance (m) or angle (rad) that counts as progress."""
FAILED_TO_MAKE_PROGRESS, COLLISION_AHEAD, TIMEOUT = 105, 714, 711
"""Error codes of Nav2."""


@dataclass
class Observation:
    """The input of a control step: time (s), pose in the map, and free room ahead and behind (m)."""

    time: float
    pose: Pose
    ahead: float = math.inf
    behind: float = math.inf


class Task:
    """An active goal. It is `done`, with an `error_code` of 0, when the goal is reached."""

    def __init__(self) -> None:
        self.done = False
        self.error_code = 0
        self._mark: tuple[float, Pose] | None = None

    def step(self, seen: Observation) -> Velocity:
        """Return the velocity for this step."""
        if self._mark is None or _moved(self._mark[1], seen.pose):
            self._mark = seen.time, seen.pose
        if seen.time - self._mark[0] > STUCK_AFTER_S:
            return self.fail(FAILED_TO_MAKE_PROGRESS)
        wanted = self.wanted(seen)
        self.done = self.done or wanted is None
        return wanted or (0.0, 0.0)

    def wanted(self, seen: Observation) -> Velocity | None:
        """Return the velocity towards the goal, or None when it is reached."""
        raise NotImplementedError

    def fail(self, error_code: int) -> Velocity:
        """Abort the goal."""
        self.done, self.error_code = True, error_code
        return 0.0, 0.0


def _moved(before: Pose, after: Pose) -> bool:
    return math.dist(before[:2], after[:2]) > MIN_PROGRESS or abs(heading_error(after[2], before[2])) > MIN_PROGRESS


class FollowPath(Task):
    """Follow points (m) and face a heading (rad)."""

    def __init__(self, points: Sequence[Point], heading: float, limits: Limits) -> None:
        super().__init__()
        self._follower = PathFollower(points, heading, limits)

    def left(self, pose: Pose) -> float:
        """The remaining metres."""
        return self._follower.left(pose)

    def wanted(self, seen: Observation) -> Velocity | None:
        """See `PathFollower.velocity`."""
        return self._follower.velocity(seen.pose, seen.ahead)


class Spin(Task):
    """Turn in place by an angle (rad), which may exceed a full turn."""

    def __init__(self, angle: float, limits: Limits) -> None:
        super().__init__()
        self.turned = 0.0
        self._angle = angle
        self._limits = limits
        self._before: float | None = None

    def wanted(self, seen: Observation) -> Velocity | None:
        """Return the velocity for the remaining turn."""
        self.turned += 0.0 if self._before is None else heading_error(seen.pose[2], self._before)
        self._before = seen.pose[2]
        left = self._angle - self.turned
        return None if abs(left) < self._limits.angle else turn_in_place(left, self._limits)


class DriveStraight(Task):
    """Drive a distance (m) at a speed (m/s); backwards if the distance is negative."""

    def __init__(self, distance: float, speed: float, allowance: float, limits: Limits) -> None:
        super().__init__()
        self.travelled = 0.0
        self._distance = distance
        self._speed = math.copysign(min(abs(speed) or limits.speed, limits.speed), distance)
        self._allowance = allowance
        self._limits = limits
        self._start: tuple[float, Pose] | None = None

    def wanted(self, seen: Observation) -> Velocity | None:
        """Drive straight ahead until the distance is covered, an obstacle is in the way, or time is up."""
        if self._start is None:
            self._start = seen.time, seen.pose
        self.travelled = math.dist(self._start[1][:2], seen.pose[:2])
        if self.travelled >= abs(self._distance) - 0.5 * self._limits.place:
            return None
        if (seen.behind if self._distance < 0 else seen.ahead) < self._limits.room:
            return self.fail(COLLISION_AHEAD)
        if self._allowance and seen.time - self._start[0] > self._allowance:
            return self.fail(TIMEOUT)
        return self._speed, 0.0


class Wait(Task):
    """Stand still for a number of seconds."""

    def __init__(self, duration: float) -> None:
        super().__init__()
        self.left = duration
        self._end: float | None = None
        self._duration = duration

    def step(self, seen: Observation) -> Velocity:
        """Return zero; standing still is the goal here, not a failure."""
        self._end = seen.time + self._duration if self._end is None else self._end
        self.left = max(0.0, self._end - seen.time)
        self.done = self.left == 0.0
        return 0.0, 0.0
