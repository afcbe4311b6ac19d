"""The origins of the frames `map` and `odom` in the world, whose own origin is its lower left corner."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from bot_console_robot.simulation.arrays import Floats
from bot_console_robot.simulation.geometry import Point, Pose
from bot_console_robot.simulation.world import World

ORIGINS = ("corner", "start")
"""`corner`: both frames coincide with the world's. `start`: both have their origin at the start pose, as on a robot
that was switched on there; `odom` also has the robot's initial heading, while `map` keeps the world's orientation.
"""


@dataclass(frozen=True, slots=True)
class Frames:
    """The origin of `map` (m) and of `odom` (m, rad), both in the world."""

    map: Point = (0.0, 0.0)
    odom: Pose = Pose()  # noqa: RUF009 -- Pose is frozen

    @classmethod
    def of(cls, world: World, origin: str) -> Frames:
        """Return the frames of a world by the name of an origin."""
        return cls() if origin == "corner" else cls((world.start.x, world.start.y), world.start)

    def in_map(self, pose: Pose) -> Pose:
        """Convert a pose of the world to `map`."""
        return Pose(pose.x - self.map[0], pose.y - self.map[1], pose.heading)

    def in_world(self, pose: Pose) -> Pose:
        """Convert a pose of `map` to the world."""
        return Pose(pose.x + self.map[0], pose.y + self.map[1], pose.heading)

    def in_odom(self, pose: Pose) -> Pose:
        """Convert a pose of the world to `odom`."""
        x, y = pose.x - self.odom.x, pose.y - self.odom.y
        cosine, sine = math.cos(self.odom.heading), math.sin(self.odom.heading)
        heading = math.remainder(pose.heading - self.odom.heading, 2.0 * math.pi)
        return Pose(cosine * x + sine * y, cosine * y - sine * x, heading)

    def rows_in_map(self, rows: Floats) -> Floats:
        """Convert rows that begin with x, y (m) of the world to `map`."""
        moved = np.array(rows)
        moved[:, :2] -= self.map
        return moved
