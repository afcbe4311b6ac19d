"""What the wheels say about where the robot is: the way they turned, with an error that grows with the way."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from bot_console_robot.simulation.geometry import TURN, Pose


@dataclass(frozen=True, slots=True)
class OdometryNoise:
    """Standard deviations after 1 m of way (m) and after 1 rad of turn (rad); they grow with the square root."""

    distance: float = 0.01
    heading: float = 0.02


class Odometry:
    """A pose summed up from noisy wheel turns; it drifts away from the truth for good."""

    def __init__(self, pose: Pose, noise: OdometryNoise, rng: np.random.Generator) -> None:
        self._x, self._y, self._heading = pose
        self.noise = noise
        self._draw = rng.standard_normal  # one number at a time: an array of two costs more than both

    @property
    def pose(self) -> Pose:
        """Where the robot would be if its wheels never slipped (m, m, rad)."""
        return Pose(self._x, self._y, self._heading)

    @pose.setter
    def pose(self, pose: Pose) -> None:
        self._x, self._y, self._heading = pose

    def advance(self, way: float, turn: float) -> None:
        """Add a forward way in m and a turn in rad, driven as an arc."""
        if way == 0.0 and turn == 0.0:
            return
        noise, draw = self.noise, self._draw
        way += noise.distance * math.sqrt(abs(way)) * draw()
        turn += noise.heading * math.sqrt(abs(turn)) * draw()
        middle = self._heading + 0.5 * turn
        self._x += way * math.cos(middle)
        self._y += way * math.sin(middle)
        self._heading = math.remainder(self._heading + turn, TURN)
