"""Chooses a velocity from a scan: towards the widest opening, slower the less room there is ahead."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = "npt.NDArray[np.float32]"

HORIZON_M = 4.0
"""Distances (m) beyond this count as free; openings beyond it are not compared."""
BRAKING_M_S2 = 1.5
"""The deceleration in m/s² used for planning the speed; less than the robot is capable of."""
DIRECTIONS = np.radians(np.arange(-90.0, 91.0, 6.0)).astype(np.float32)
"""Candidate headings, in rad from straight ahead."""
AHEAD = len(DIRECTIONS) // 2
STEERING = 2.0
"""Turn rate per rad of angle to the opening, in 1/s."""
TURN_COST = 0.9
"""Extra room (m) that a turn of 1 rad must gain."""
HEADING_CHANGE_COST = 0.3
"""Extra room (m) that changing the heading by 1 rad must gain."""
WANDER = 0.55
"""Heading offset (rad) that breaks ties; without it, the robot would follow the same wall for ever."""
WANDER_PERIODS = (173.0, 282.0)
"""Periods, in scans, of the two waves of this offset; their sum hardly ever repeats."""


@dataclass(frozen=True, slots=True)
class Rules:
    """The navigator's parameters as used here: m/s, m, 0 to 255, rad/s."""

    max_speed: float
    safety_distance: float
    detection_threshold: int
    turn_rate: float
    enable_safety: bool


@dataclass(frozen=True, slots=True)
class Decision:
    """A velocity in m/s and rad/s, whether the way is blocked, and the distance (m) of the nearest return, or `inf`."""

    linear: float
    angular: float
    blocked: bool
    nearest: float


class Avoidance:
    """Chooses a velocity for each scan; the only state is the direction in which it is turning."""

    def __init__(self) -> None:
        self._heading = 0.0
        self._side = 0.0
        self._scans = 0
        self._angles = np.empty(0, np.float32)
        self._rotation = (np.empty(0, np.float32), np.empty(0, np.float32))
        self._cos = np.cos(DIRECTIONS)[:, None]
        self._sin = np.sin(DIRECTIONS)[:, None]

    def decide(self, ranges: Floats, intensities: Floats, first: float, increment: float, rules: Rules) -> Decision:
        """Return the velocity for a scan whose beam 0 points at `first` rad, with `increment` rad between beams."""
        seen = (ranges > 0.0) & np.isfinite(ranges)
        if len(intensities) == len(ranges):
            seen &= intensities >= rules.detection_threshold
        cos, sin = self._beams(len(ranges), first, increment)
        # Returns beyond the horizon do not block any lane.
        near = (seen & (ranges < HORIZON_M + rules.safety_distance)).nonzero()[0]
        depth = ranges.take(near)
        within = depth if len(near) else ranges[seen]
        nearest = float(within.min()) if len(within) else math.inf
        room = self._room(depth * cos.take(near), depth * sin.take(near), rules.safety_distance)
        if rules.enable_safety and float(room[AHEAD]) <= rules.safety_distance:
            side = self._keep_side(np.where(seen, ranges, np.float32(HORIZON_M)))
            return Decision(0.0, side * rules.turn_rate, True, nearest)
        self._side = 0.0
        linear, angular = self._steer(room, rules)
        return Decision(linear, angular, False, nearest)

    def _beams(self, count: int, first: float, increment: float) -> tuple[Floats, Floats]:
        if len(self._angles) != count or (count and abs(float(self._angles[0]) - first) > 1e-6):
            self._angles = (first + increment * np.arange(count)).astype(np.float32)
            self._rotation = (np.cos(self._angles), np.sin(self._angles))
        return self._rotation

    def _room(self, x: Floats, y: Floats, half_width: float) -> Floats:
        """Return how far a lane of width `2 * half_width` is free in each direction, in m."""
        if not len(x):
            return np.full(len(DIRECTIONS), HORIZON_M, np.float32)
        along, across = self._cos * x, self._cos * y
        along += self._sin * y
        across -= self._sin * x
        in_lane = np.abs(across, across) < half_width
        in_lane &= along > 0.0
        return np.minimum(np.where(in_lane, along, HORIZON_M).min(axis=1), HORIZON_M)

    def _steer(self, room: Floats, rules: Rules) -> tuple[float, float]:
        """Return the velocity towards the best direction."""
        self._scans += 1
        score = (
            room
            - TURN_COST * np.abs(DIRECTIONS - self._wander_offset())
            - HEADING_CHANGE_COST * np.abs(DIRECTIONS - self._heading)
        )
        self._heading = float(DIRECTIONS[int(score.argmax())])
        angular = max(-rules.turn_rate, min(rules.turn_rate, STEERING * self._heading))
        if not rules.enable_safety:
            return rules.max_speed, angular
        spare = float(room[AHEAD]) - rules.safety_distance
        fastest = min(rules.max_speed, math.sqrt(2.0 * BRAKING_M_S2 * spare))
        return fastest * max(0.2, math.cos(self._heading)), angular

    def _wander_offset(self) -> float:
        """Return the present heading offset (rad) that breaks ties; see `WANDER`."""
        return 0.5 * WANDER * sum(math.sin(math.tau * self._scans / period) for period in WANDER_PERIODS)

    def _keep_side(self, ranges: Floats) -> float:
        """Return which way to turn on the spot, +1 (left) or -1: to the more open side, and then the same way until the
        robot is free.

        In a corner, choosing again each time would make it alternate for ever.
        """
        if self._side == 0.0:
            capped = np.minimum(ranges, HORIZON_M)
            left, right = capped[self._angles > 0.0], capped[self._angles < 0.0]
            self._side = 1.0 if left.sum() >= right.sum() else -1.0
        return self._side
