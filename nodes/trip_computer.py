"""A trip computer: speed, distance and stops from the speeds reported by odometry."""

from __future__ import annotations

MOVING_M_S = 0.05
"""A speed in m/s above which the robot counts as driving."""
STANDING_M_S = 0.02
"""A speed in m/s below which it stands still."""
MAX_GAP_S = 1.0
"""Gaps in odometry longer than this, in s, do not count as distance."""


class Trip:
    """Accumulates speeds over time; restarts when time runs backwards, as it does when a world is reset."""

    def __init__(self) -> None:
        self.speed = 0.0
        self.distance = 0.0
        self.stops = 0
        self._time: float | None = None
        self._driving = False

    def update(self, time: float, speed: float) -> None:
        """Record a speed in m/s at a time in s."""
        if self._time is not None and time < self._time:
            self.distance, self.stops, self._driving = 0.0, 0, False
        elif self._time is not None and time - self._time <= MAX_GAP_S:
            self.distance += 0.5 * (abs(self.speed) + abs(speed)) * (time - self._time)
        self._time = time
        self.speed = speed
        if self._driving and abs(speed) < STANDING_M_S:
            self._driving = False
            self.stops += 1
        elif abs(speed) > MOVING_M_S:
            self._driving = True
