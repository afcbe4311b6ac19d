"""A trip computer: speed, way and stops from the speeds that odometry reports."""

from __future__ import annotations

MOVING = 0.05
"""A speed in m/s from which the robot drives."""
STANDING = 0.02
"""A speed in m/s below which it stands."""
GAP = 1.0
"""Seconds without odometry that are not counted as way."""


class Trip:
    """Sums over speeds with their times; starts anew when time runs backwards, as it does when a world is reset."""

    def __init__(self) -> None:
        self.speed = 0.0
        self.distance = 0.0
        self.stops = 0
        self._time: float | None = None
        self._driving = False

    def update(self, time: float, speed: float) -> None:
        """Take a speed in m/s at a time in s."""
        if self._time is not None and time < self._time:
            self.distance, self.stops, self._driving = 0.0, 0, False
        elif self._time is not None and time - self._time <= GAP:
            self.distance += 0.5 * (abs(self.speed) + abs(speed)) * (time - self._time)
        self._time = time
        self.speed = speed
        if self._driving and abs(speed) < STANDING:
            self._driving = False
            self.stops += 1
        elif abs(speed) > MOVING:
            self._driving = True
