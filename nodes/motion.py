"""Velocity control: smooth changes of speed, and driving to waypoints."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

REACHED_M = 0.35
"""Distance in m from a waypoint at which it counts as reached."""
CRUISE_M_S = 0.5
"""The speed in m/s towards a waypoint if no limit is given."""
DETOUR_S = 2.0
"""Seconds for which an obstacle is avoided before the robot heads for the waypoint again."""
CREEP_M_S = 0.05
"""An allowed speed in m/s below which the way counts as blocked."""


@dataclass(frozen=True, slots=True)
class Gains:
    """Proportional gains in 1/s, and the largest acceleration in m/s²."""

    kp_linear: float
    kp_angular: float
    max_acceleration: float


class VelocityController:
    """Ramps the velocity up towards the requested one; deceleration is never delayed."""

    def __init__(self) -> None:
        self.linear = 0.0
        self.angular = 0.0

    def step(self, linear: float, angular: float, dt: float, gains: Gains) -> tuple[float, float]:
        """Return the velocity (m/s, rad/s) to command after `dt` s of ramping towards the requested one."""
        if abs(linear) <= abs(self.linear) and linear * self.linear >= 0.0:
            self.linear = linear
        else:
            change = gains.kp_linear * (linear - self.linear)
            change = max(-gains.max_acceleration, min(gains.max_acceleration, change))
            self.linear += change * dt
        self.angular += (angular - self.angular) * min(1.0, gains.kp_angular * dt)
        return self.linear, self.angular

    def reset(self) -> None:
        """Reset the velocity to zero, because something else has stopped the robot."""
        self.linear = self.angular = 0.0


class WaypointFollower:
    """Drives to one waypoint after another; obstacle avoidance takes precedence."""

    def __init__(self) -> None:
        self._points: deque[tuple[float, float]] = deque()
        self._loop = False
        self._detour = 0.0

    def follow(self, points: Iterable[tuple[float, float]], loop: bool = False) -> None:
        """Drive to these points (m) in order, repeatedly if `loop`; an empty list stops following."""
        self._points = deque(points)
        self._loop = loop
        self._detour = 0.0

    @property
    def target(self) -> tuple[float, float] | None:
        """The current waypoint; None if there is none."""
        return self._points[0] if self._points else None

    def arrived(self, x: float, y: float) -> bool:
        """Return whether the target is reached at this position; if so, make the next waypoint the target."""
        if not self._points or math.dist((x, y), self._points[0]) > REACHED_M:
            return False
        point = self._points.popleft()
        if self._loop:
            self._points.append(point)
        return True

    def steer(
        self,
        pose: tuple[float, float, float],
        allowed: tuple[float, float] | None,
        dt: float,
        gains: Gains,
    ) -> tuple[float, float]:
        """Return the velocity towards the target from x, y (m), heading (rad).

        `allowed` is the navigator's velocity: it limits the speed, and replaces the result where the way is blocked.
        """
        self._detour = max(0.0, self._detour - dt)
        if allowed and allowed[0] < CREEP_M_S:
            self._detour = DETOUR_S
        if allowed and self._detour > 0.0:
            return allowed
        assert self._points
        dx, dy = self._points[0][0] - pose[0], self._points[0][1] - pose[1]
        error = math.remainder(math.atan2(dy, dx) - pose[2], 2 * math.pi)
        speed = gains.kp_linear * math.hypot(dx, dy) * max(0.0, math.cos(error))
        fastest = allowed[0] if allowed else CRUISE_M_S
        return min(speed, fastest), gains.kp_angular * error
