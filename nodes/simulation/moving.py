"""Moving obstacles: people and carts that give way to the robot, and turn back when it does not move on."""

from __future__ import annotations

import math

import numpy as np
import pymunk
from bot_console_robot.simulation.engine import Body
from bot_console_robot.simulation.geometry import Mover, Point

PATIENCE = 2.0
"""Seconds they wait before they turn back."""


class MovingObstacle:
    """One mover on its way; its body is kinematic, so nothing pushes it."""

    def __init__(self, mover: Mover, rng: np.random.Generator) -> None:
        self.mover = mover
        self._rng = rng
        self._route: tuple[Point, ...] = mover.route
        self._next = 1
        self._direction = 1
        self._waited = 0.0
        self.body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self._body = Body(self.body)
        self.x, self.y = mover.route[0] if mover.route else self._random_place()
        self._target = mover.route[1] if mover.route else self._random_place()
        self.body.position = (self.x, self.y)

    def _random_place(self) -> Point:
        assert self.mover.area is not None
        x0, y0, x1, y1 = self.mover.area
        return float(self._rng.uniform(x0, x1)), float(self._rng.uniform(y0, y1))

    def advance(self, dt: float, robot: Point, radius: float) -> None:
        """Go on for `dt` s, unless that comes too near to the robot's hull of `radius` m."""
        mover, begin_x, begin_y = self.mover, self.x, self.y
        x, y = self._next_place(mover.speed * dt)
        distance = math.dist((x, y), robot)
        if distance < radius + mover.radius + mover.keep_off and distance < math.dist((begin_x, begin_y), robot):
            self._wait(dt)
        else:
            self._waited = 0.0
            self.x, self.y = x, y
        # The engine moves the body by its velocity; the place it moves from is set, so that rounding never adds up.
        self._body.move(begin_x, begin_y, (self.x - begin_x) / dt, (self.y - begin_y) / dt)

    def _next_place(self, way: float) -> Point:
        x, y = self.x, self.y
        target_x, target_y = target = self._target
        left = math.dist((x, y), target)
        if left <= way:
            self._choose_next()
            return target
        share = way / left
        return x + (target_x - x) * share, y + (target_y - y) * share

    def _wait(self, dt: float) -> None:
        self._waited += dt
        if self._waited >= PATIENCE:
            self._waited = 0.0
            self._direction = -self._direction
            self._choose_next()

    def _choose_next(self) -> None:
        if not self._route:
            self._target = self._random_place()
            return
        self._next = (self._next + self._direction) % len(self._route)
        self._target = self._route[self._next]
