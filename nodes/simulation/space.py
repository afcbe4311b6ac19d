"""A world as a pymunk space: what stands still, what moves by itself, and the robot's body."""

from __future__ import annotations

import itertools
import math
from typing import Any

import pymunk
from bot_console_robot.simulation import engine
from bot_console_robot.simulation.engine import ffi, lib, pointer
from bot_console_robot.simulation.engine_memory import EngineMemory
from bot_console_robot.simulation.geometry import Disc, Pose, closed
from bot_console_robot.simulation.moving import MovingObstacle
from bot_console_robot.simulation.world import World

OBSTACLE = pymunk.ShapeFilter(categories=0b01)
ROBOT = pymunk.ShapeFilter(categories=0b10)
OBSTACLES_ONLY = pymunk.ShapeFilter(mask=0b01)
FAR = 5.0
"""Distances in m beyond which nothing is looked for."""
NEAR = 0.25
"""How much further (m) than the last distance it is looked at first: in one step nothing comes from beyond that."""
MASS = 10.0
SLOP = 0.001


class Space:
    """The physics of one world with a round robot in it; the caller sets its velocity before each step.

    It owns the bodies of the movers too: they may not be used when it is gone.
    """

    def __init__(self, world: World, movers: list[MovingObstacle], pose: Pose, radius: float) -> None:
        self._memory = EngineMemory()
        self._space = pymunk.Space()
        self._memory.take(self._space, self._space.static_body)
        self._space.collision_slop = SLOP
        self._pointer = pointer(self._space)
        self._kinds: dict[Any, str] = {}
        self._radius = radius
        self._reach = FAR
        self._place, self._found = ffi.new("cpVect *"), ffi.new("cpPointQueryInfo *")
        self._obstacles = ffi.new("cpShapeFilter *", tuple(OBSTACLES_ONLY))
        self._add_still(world)
        for mover in movers:
            self._add(pymunk.Circle(mover.body, mover.mover.radius), "a moving obstacle", mover.body)
        self._robot = pymunk.Body(MASS, pymunk.moment_for_circle(MASS, 0, radius))
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
        """Put the robot somewhere, at rest."""
        robot = self._robot
        robot.position, robot.angle = (pose.x, pose.y), pose.heading
        robot.velocity, robot.angular_velocity = (0.0, 0.0), 0.0
        self._space.reindex_shapes_for_body(robot)
        self._angle = pose.heading

    def step(self, dt: float, linear: float, angular: float) -> tuple[float, float, float]:
        """Let `dt` s pass with the robot's wheels driving at m/s and rad/s; walls hold it back.

        Returns where it then is: x, y (m), and the angle (rad), which goes on growing beyond a turn.
        """
        body = self._body
        velocity, turning = engine.velocity(body), engine.turn_rate(body)
        # A step moves bodies first and resolves contacts after, so a velocity set here would pass through walls.
        # As a force it is resolved against them; the heading is that of the middle of the move it leads to.
        heading = self._angle + (turning + 0.5 * angular) * dt
        push = MASS / dt
        force = (linear * math.cos(heading) - velocity.x) * push, (linear * math.sin(heading) - velocity.y) * push
        engine.set_force(body, force)
        engine.set_torque(body, (angular - turning) * self._moment / dt)
        engine.step(self._pointer, dt)
        place = engine.position(body)
        self._angle = angle = engine.angle(body)
        return place.x, place.y, angle

    def nearest(self, x: float, y: float) -> tuple[float, str]:
        """The gap in m between a robot standing there and the nearest thing, negative within it, and its kind."""
        # What is found within a short reach is the nearest within any, and far fewer shapes are looked at for it.
        found = self._find(x, y, self._reach)
        if not found and self._reach < FAR:
            found = self._find(x, y, FAR)
        if not found:
            self._reach = FAR
            return math.inf, ""
        distance: float = self._found.distance
        self._reach = min(FAR, max(0.0, distance) + NEAR)
        return distance - self._radius, self._kinds[found]

    def _find(self, x: float, y: float, reach: float) -> Any:
        """The nearest shape within a reach, or nothing; more of it is in `_found`."""
        self._place.x, self._place.y = x, y
        return lib.cpSpacePointQueryNearest(self._pointer, self._place[0], reach, self._obstacles[0], self._found)

    def distance_ahead(self, x: float, y: float, angle: float, reach: float) -> float:
        """The distance in m to the first surface in a direction, one beam at a time; `inf` beyond `reach`."""
        end = (x + reach * math.cos(angle), y + reach * math.sin(angle))
        found = self._space.segment_query_first((x, y), end, 0.0, OBSTACLES_ONLY)
        return math.inf if found is None else found.alpha * reach


def _circle(body: pymunk.Body, disc: Disc) -> pymunk.Circle:
    return pymunk.Circle(body, disc.radius, (disc.x, disc.y))
