"""Velocities for following a path, turning in place, and driving a distance."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

Point = tuple[float, float]
Pose = tuple[float, float, float]
"""x (m), y (m), heading (rad)."""
Velocity = tuple[float, float]
"""Linear (m/s) and angular (rad/s) velocity."""

CORNER_RADIUS_M = 0.25
"""Distance (m) from a corner of the path at which the robot heads for the next one."""
TURN_FIRST_RAD = 0.6
"""Angle (rad) to the next point above which the robot turns in place first."""
GAIN = 2.0
"""Turn rate per rad of error (1/s)."""


@dataclass(frozen=True)
class Limits:
    """Speeds (m/s, rad/s), the goal tolerance (m, rad), and the stopping distance to obstacles ahead (m)."""

    speed: float = 0.4
    turn_rate: float = 1.0
    place: float = 0.15
    angle: float = 0.1
    room: float = 0.35


def heading_error(wanted: float, is_now: float) -> float:
    """Return the angle (rad) from the present heading to the wanted one, the shorter way round."""
    return math.remainder(wanted - is_now, 2.0 * math.pi)


def turn_in_place(error: float, limits: Limits) -> Velocity:
    """Return the velocity for turning in place by an angle (rad)."""
    rate = max(-limits.turn_rate, min(limits.turn_rate, GAIN * error))
    return 0.0, math.copysign(max(abs(rate), 0.15), error)


class PathFollower:
    """Follows points, then turns to a final heading."""

    def __init__(self, points: Sequence[Point], heading: float, limits: Limits) -> None:
        self.points = list(points)
        self.heading = heading
        self._limits = limits

    def left(self, pose: Pose) -> float:
        """The length of the remaining path in m."""
        places = [(pose[0], pose[1]), *self.points]
        return math.fsum(math.dist(a, b) for a, b in itertools.pairwise(places))

    def velocity(self, pose: Pose, ahead: float) -> Velocity | None:
        """Return the velocity at a pose with this much room ahead (m); None when the goal is reached."""
        limits = self._limits
        while len(self.points) > 1 and math.dist(pose[:2], self.points[0]) < CORNER_RADIUS_M:
            self.points.pop(0)
        if len(self.points) == 1 and math.dist(pose[:2], self.points[0]) < limits.place:
            self.points.clear()
        if not self.points:
            error = heading_error(self.heading, pose[2])
            return None if abs(error) < limits.angle else turn_in_place(error, limits)
        x, y = self.points[0]
        error = heading_error(math.atan2(y - pose[1], x - pose[0]), pose[2])
        if abs(error) > TURN_FIRST_RAD:
            return turn_in_place(error, limits)
        speed = min(limits.speed, math.sqrt(0.8 * max(0.0, self.left(pose))), max(0.0, ahead - limits.room))
        return speed * math.cos(error), max(-limits.turn_rate, min(limits.turn_rate, GAIN * error))
