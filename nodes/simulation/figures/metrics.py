"""Figures about a run, computed from the true poses: distance, speed, clearance, standstill."""

from __future__ import annotations

import math

from bot_console_robot.simulation.figures.digest import VERSION, PoseDigest

MOVING_M_S = 0.05
"""A speed in m/s above which the robot counts as driving."""
STANDING_M_S = 0.02
"""A speed in m/s below which it stands still; turning in place counts as standing."""


class Metrics:
    """Sums over a run in constant steps of `dt` s."""

    def __init__(self, dt: float) -> None:
        self._dt = dt
        self._digest = PoseDigest()
        self._driving = False
        self._standing_since = 0
        self.steps = 0
        self.distance = 0.0
        self.min_clearance = math.inf
        self.stops = 0
        self._longest = 0

    def update(self, x: float, y: float, heading: float, speed: float) -> None:
        """Record the true state after a step: m, m, rad, m/s."""
        self.steps += 1
        self._digest.add(x, y, heading)
        speed = abs(speed)
        self.distance += speed * self._dt
        if speed >= STANDING_M_S:
            self._standing_since = self.steps
            if speed > MOVING_M_S:
                self._driving = True
            return
        if self._driving:
            self._driving = False
            self.stops += 1
        self._longest = max(self._longest, self.steps - self._standing_since)

    def pass_by(self, clearance: float) -> None:
        """Record the clearance in m from the hull to the nearest obstacle, if it may be the smallest so far."""
        self.min_clearance = min(self.min_clearance, clearance)

    @property
    def duration(self) -> float:
        """The simulated time so far, in s."""
        return self.steps * self._dt

    @property
    def mean_speed(self) -> float:
        """The distance driven divided by the time, in m/s."""
        return self.distance / self.duration if self.steps else 0.0

    @property
    def longest_standstill(self) -> float:
        """The longest time without driving, in s."""
        return self._longest * self._dt

    @property
    def digest(self) -> str:
        """A hash of every pose of the run, bit by bit."""
        return self._digest.hex

    def report(self) -> dict[str, float | int | str | None]:
        """Return the figures by name, ready for JSON; `min_clearance` is None while nothing was near."""
        near = self.min_clearance
        return {
            "duration": round(self.duration, 6),
            "distance": round(self.distance, 6),
            "mean_speed": round(self.mean_speed, 6),
            "min_clearance": round(near, 6) if math.isfinite(near) else None,
            "stops": self.stops,
            "longest_standstill": round(self.longest_standstill, 6),
            "digest": self.digest,
            "digest_version": VERSION,
        }
