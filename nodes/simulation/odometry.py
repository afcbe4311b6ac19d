"""Wheel odometry: integrates wheel motion with an error that grows with distance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from bot_console_robot.simulation.geometry import TURN, Pose


@dataclass(frozen=True, slots=True)
class OdometryNoise:
    """Standard deviations after 1 m of travel (m) and after 1 rad of turning (rad); they grow with the square root."""

    distance: float = 0.01
    heading: float = 0.02


class Odometry:
    """A pose integrated from noisy wheel motion; its drift is never corrected."""

    def __init__(self, pose: Pose, noise: OdometryNoise, rng: np.random.Generator) -> None:
        self._x, self._y, self._heading = pose
        self.noise = noise
        self._draw = rng.standard_normal  # one number at a time, since an array of two costs more

    @property
    def pose(self) -> Pose:
        """The estimated pose (m, m, rad)."""
        return Pose(self._x, self._y, self._heading)

    @pose.setter
    def pose(self, pose: Pose) -> None:
        self._x, self._y, self._heading = pose

    def advance(self, way: float, turn: float) -> None:
        """Add forward travel in m and a turn in rad, driven as an arc."""
        if way == 0.0 and turn == 0.0:
            return
        noise, draw = self.noise, self._draw
        way += noise.distance * math.sqrt(abs(way)) * draw()
        turn += noise.heading * math.sqrt(abs(turn)) * draw()
        middle = self._heading + 0.5 * turn
        self._x += way * math.cos(middle)
        self._y += way * math.sin(middle)
        self._heading = math.remainder(self._heading + turn, TURN)
