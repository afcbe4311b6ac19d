"""Moving obstacles: people and carts that give way to the robot, and turn back when it does not move on."""

from __future__ import annotations

import math

import numpy as np
import pymunk
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
        self.x, self.y = mover.route[0] if mover.route else self._random_place()
        self._target = mover.route[1] if mover.route else self._random_place()
        self.body.position = (self.x, self.y)

    def _random_place(self) -> Point:
        assert self.mover.area is not None
        x0, y0, x1, y1 = self.mover.area
        return float(self._rng.uniform(x0, x1)), float(self._rng.uniform(y0, y1))

    def advance(self, dt: float, robot: Point, radius: float) -> None:
        """Go on for `dt` s, unless that comes too near to the robot's hull of `radius` m."""
        x, y = self._next_place(dt)
        if self._would_crowd(x, y, robot, radius):
            self._wait(dt)
            x, y = self.x, self.y
        else:
            self._waited = 0.0
        # The engine moves the body by its velocity; the place it moves from is set, so that rounding never adds up.
        self.body.position = (self.x, self.y)
        self.body.velocity = ((x - self.x) / dt, (y - self.y) / dt)
        self.x, self.y = x, y

    def _next_place(self, dt: float) -> Point:
        way = self.mover.speed * dt
        left = math.dist((self.x, self.y), self._target)
        if left <= way:
            place = self._target
            self._choose_next()
            return place
        share = way / left
        return self.x + (self._target[0] - self.x) * share, self.y + (self._target[1] - self.y) * share

    def _would_crowd(self, x: float, y: float, robot: Point, radius: float) -> bool:
        distance = math.dist((x, y), robot)
        return distance < radius + self.mover.radius + self.mover.keep_off and distance < math.dist(
            (self.x, self.y), robot
        )

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
