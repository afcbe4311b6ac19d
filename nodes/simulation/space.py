"""A world as a pymunk space: static obstacles, moving obstacles, and the robot's body."""

from __future__ import annotations

import itertools
import math
from typing import Any

import pymunk
from bot_console_robot.simulation import engine
from bot_console_robot.simulation.engine import ffi, lib, pointer
from bot_console_robot.simulation.engine_memory import EngineMemory
from bot_console_robot.simulation.geometry import Disc, Pose, closed
from bot_console_robot.simulation.moving_obstacles import MovingObstacle
from bot_console_robot.simulation.world import World

OBSTACLE = pymunk.ShapeFilter(categories=0b01)
ROBOT = pymunk.ShapeFilter(categories=0b10)
OBSTACLES_ONLY = pymunk.ShapeFilter(mask=0b01)
FAR_M = 5.0
"""Distance in m beyond which obstacles are not searched for."""
NEAR_M = 0.25
"""Margin (m) added to the last distance for the first search; nothing farther away can come near within one step."""
MASS_KG = 10.0
SLOP_M = 0.001
"""The depth (m) to which bodies may overlap without being pushed apart."""


class Space:
    """The physics of one world with a round robot in it, whose velocity the caller sets with each step.

    It also owns the bodies of the movers, which must not be used after it has been freed.
    """

    def __init__(self, world: World, movers: list[MovingObstacle], pose: Pose, radius: float) -> None:
        self._memory = EngineMemory()
        self._space = pymunk.Space()
        self._memory.take(self._space, self._space.static_body)
        self._space.collision_slop = SLOP_M
        self._pointer = pointer(self._space)
        self._kinds: dict[Any, str] = {}
        self._radius = radius
        self._reach = FAR_M
        self._place, self._found = ffi.new("cpVect *"), ffi.new("cpPointQueryInfo *")
        self._obstacles = ffi.new("cpShapeFilter *", tuple(OBSTACLES_ONLY))
        self._add_still(world)
        for mover in movers:
            self._add(pymunk.Circle(mover.body, mover.mover.radius), "a moving obstacle", mover.body)
        self._robot = pymunk.Body(MASS_KG, pymunk.moment_for_circle(MASS_KG, 0, radius))
        hull = pymunk.Circle(self._robot, radius)
        hull.filter = ROBOT
        self._memory.take(self._robot, hull)
        self._space.add(self._robot, hull)
        self._body, self._moment = pointer(self._robot), self._robot.moment
        self.place(pose)

    def __del__(self) -> None:
        self._memory.free()

    def _add_still(self, world: World) -> None:
        still = self._space.static_body
        lines = [("the boundary", closed(world.boundary))] + [("a wall", wall.points) for wall in world.walls]
        for kind, points in lines:
            for a, b in itertools.pairwise(points):
                self._add(pymunk.Segment(still, a, b, 0.0), kind)
        for block in world.blocks:
            self._add(pymunk.Poly(still, list(block.points)), "an obstacle")
        for disc in world.discs:
            self._add(_circle(still, disc), "an obstacle")

    def _add(self, shape: pymunk.Shape, kind: str, body: pymunk.Body | None = None) -> None:
        shape.filter = OBSTACLE
        self._kinds[pointer(shape)] = kind
        parts = (body, shape) if body else (shape,)
        self._memory.take(*parts)
        self._space.add(*parts)

    def place(self, pose: Pose) -> None:
        """Place the robot somewhere, at rest."""
        robot = self._robot
        robot.position, robot.angle = (pose.x, pose.y), pose.heading
        robot.velocity, robot.angular_velocity = (0.0, 0.0), 0.0
        self._space.reindex_shapes_for_body(robot)
        self._angle = pose.heading

    def step(self, dt: float, linear: float, angular: float) -> tuple[float, float, float]:
        """Advance by `dt` s while the robot's wheels drive at `linear` m/s and `angular` rad/s; walls hold it back.

        Returns the new pose: x, y (m), and the angle (rad), which keeps growing beyond a full turn.
        """
        body = self._body
        velocity, turning = engine.velocity(body), engine.turn_rate(body)
        # A step moves bodies first and resolves contacts afterwards, so a velocity set here would carry the robot
        # through walls. A force is resolved against them; the heading is that at the middle of the resulting move.
        heading = self._angle + (turning + 0.5 * angular) * dt
        push = MASS_KG / dt
        force = (linear * math.cos(heading) - velocity.x) * push, (linear * math.sin(heading) - velocity.y) * push
        engine.set_force(body, force)
        engine.set_torque(body, (angular - turning) * self._moment / dt)
        engine.step(self._pointer, dt)
        place = engine.position(body)
        self._angle = angle = engine.angle(body)
        return place.x, place.y, angle

    def nearest(self, x: float, y: float) -> tuple[float, str]:
        """Return the gap (m) between a robot at a position and the nearest obstacle, negative inside, and its kind."""
        # If there is an obstacle within a short reach, it is the nearest overall, and few shapes have to be checked.
        found = self._find(x, y, self._reach)
        if not found and self._reach < FAR_M:
            found = self._find(x, y, FAR_M)
        if not found:
            self._reach = FAR_M
            return math.inf, ""
        distance: float = self._found.distance
        self._reach = min(FAR_M, max(0.0, distance) + NEAR_M)
        return distance - self._radius, self._kinds[found]

    def _find(self, x: float, y: float, reach: float) -> Any:
        """Return the nearest shape within a reach, or a null pointer; details are in `_found`."""
        self._place.x, self._place.y = x, y
        return lib.cpSpacePointQueryNearest(self._pointer, self._place[0], reach, self._obstacles[0], self._found)

    def distance_ahead(self, x: float, y: float, angle: float, reach: float) -> float:
        """Return the distance in m to the first surface in one direction; `inf` beyond `reach`."""
        end = (x + reach * math.cos(angle), y + reach * math.sin(angle))
        found = self._space.segment_query_first((x, y), end, 0.0, OBSTACLES_ONLY)
        return math.inf if found is None else found.alpha * reach


def _circle(body: pymunk.Body, disc: Disc) -> pymunk.Circle:
    return pymunk.Circle(body, disc.radius, (disc.x, disc.y))
