"""Moving obstacles: people and carts that give way to the robot, and turn back if it does not move away."""

from __future__ import annotations

import math

import numpy as np
import pymunk
from bot_console_robot.simulation.engine import pointer, set_position, set_velocity
from bot_console_robot.simulation.geometry import Mover, Point

TURN_BACK_AFTER_S = 2.0
"""Seconds that an obstacle waits for the robot before it turns back."""


class MovingObstacle:
    """One moving obstacle; its body is kinematic, so nothing pushes it."""

    def __init__(self, mover: Mover, rng: np.random.Generator) -> None:
        self.mover = mover
        self._rng = rng
        self._route: tuple[Point, ...] = mover.route
        self._next = 1
        self._direction = 1
        self._waited = 0.0
        self.body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self._pointer = pointer(self.body)
        self._place = mover.route[0] if mover.route else self._random_place()
        self._target = mover.route[1] if mover.route else self._random_place()
        self.body.position = self._place

    @property
    def place(self) -> Point:
        """The current position (m)."""
        return self._place

    def _random_place(self) -> Point:
        assert self.mover.area is not None
        x0, y0, x1, y1 = self.mover.area
        return float(self._rng.uniform(x0, x1)), float(self._rng.uniform(y0, y1))

    def advance(self, dt: float, robot: Point, radius: float) -> None:
        """Move on for `dt` s, unless that comes too close to the robot's hull of `radius` m."""
        mover, begin = self.mover, self._place
        begin_x, begin_y = begin
        target_x, target_y = place = self._target
        way, left = mover.speed * dt, math.dist(begin, place)
        if left <= way:
            self._choose_next()
        else:
            share = way / left
            place = begin_x + (target_x - begin_x) * share, begin_y + (target_y - begin_y) * share
        distance = math.dist(place, robot)
        if distance < radius + mover.radius + mover.keep_off and distance < math.dist(begin, robot):
            self._wait(dt)
            place = begin
        else:
            self._waited = 0.0
            self._place = place
        # The engine moves the body by its velocity; setting the position before each step keeps rounding errors from
        # adding up.
        set_position(self._pointer, begin)
        set_velocity(self._pointer, ((place[0] - begin_x) / dt, (place[1] - begin_y) / dt))

    def _wait(self, dt: float) -> None:
        self._waited += dt
        if self._waited >= TURN_BACK_AFTER_S:
            self._waited = 0.0
            self._direction = -self._direction
            self._choose_next()

    def _choose_next(self) -> None:
        if not self._route:
            self._target = self._random_place()
            return
        self._next = (self._next + self._direction) % len(self._route)
        self._target = self._route[self._next]
