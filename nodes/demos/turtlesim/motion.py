"""The motion of a turtle. Pure; steps, rounding and walls match turtlesim, so that paths are identical."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

FRAME = 0.016
"""Duration of a step in s."""
PIXELS = 500
"""Width and height of the field."""
METRE = 45.0
"""Pixels per metre: the height of a turtle."""
SIDE = float(np.float32((PIXELS - 1) / METRE))
"""Width and height of the field in m."""
COMMAND_TIMEOUT_S = 1.0
"""Seconds after which a velocity command expires."""
ROTATION_SPEED = 1.0
"""Turn rate (rad/s) towards the target of a rotation."""
ROTATION_TOLERANCE = 0.02
"""Angle (rad) to the target at which a rotation is complete."""
PI = 3.14159265
"""Truncated as in turtlesim, since that affects angles."""


def single(value: float) -> float:
    """Round a number to a 32-bit float."""
    return float(np.float32(value))


def normalized(angle: float) -> float:
    """Normalize an angle to the range -pi to pi."""
    return angle - 2.0 * PI * math.floor((angle + PI) / (2.0 * PI))


@dataclass
class Motion:
    """Position and velocity of a turtle: m from the upper left corner, y downwards; rad counter-clockwise from +x."""

    x: float
    y: float
    heading: float
    forward: float = 0.0
    sideways: float = 0.0
    turn: float = 0.0

    @property
    def position(self) -> tuple[float, float]:
        """The position (m), y upwards, as in the turtle's pose."""
        return self.x, SIDE - self.y

    @property
    def speed(self) -> float:
        """The speed (m/s); never negative."""
        return math.sqrt(self.forward * self.forward + self.sideways * self.sideways)

    def command(self, forward: float, sideways: float, turn: float) -> None:
        """Move with a velocity (m/s, m/s, rad/s) from the next step on."""
        self.forward, self.sideways, self.turn = forward, sideways, turn

    def stop(self) -> None:
        """Stand still."""
        self.command(0.0, 0.0, 0.0)

    def teleport(self, x: float, y: float, heading: float) -> None:
        """Jump to a pose (m, y upwards, rad); the next step clamps it to the field."""
        self.x, self.y, self.heading = x, max(0.0, SIDE - y), heading

    def jump(self, distance: float, angle: float) -> None:
        """Turn by an angle (rad) and go a distance (m) at once."""
        self.heading += angle
        self.x += math.cos(self.heading) * distance
        self.y -= math.sin(self.heading) * distance

    def step(self) -> tuple[float, float] | None:
        """Move for one frame; if a wall is in the way, return the position (m, y downwards) that would have been
        reached.
        """
        self.heading = normalized(self.heading + self.turn * FRAME)
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        self.x += cosine * self.forward * FRAME - sine * self.sideways * FRAME
        self.y -= cosine * self.sideways * FRAME + sine * self.forward * FRAME
        wanted = self.x, self.y
        self.x, self.y = (min(max(each, 0.0), SIDE) for each in wanted)
        return None if (self.x, self.y) == wanted else wanted


@dataclass
class Rotation:
    """A goal of the action `rotate_absolute`: the direction to face (rad), and the initial direction."""

    goal: float
    start: float
    remaining: float = 0.0
    delta: float = 0.0

    def drive(self, motion: Motion) -> bool:
        """Turn the turtle towards the goal; when it faces the goal, stop it and return True."""
        heading, goal = single(motion.heading), normalized(self.goal)
        self.remaining = normalized(goal - heading)
        self.delta = normalized(single(self.start - motion.heading))
        if abs(normalized(heading - goal)) < ROTATION_TOLERANCE:
            motion.stop()
            return True
        motion.command(0.0, 0.0, math.copysign(ROTATION_SPEED, self.remaining))
        return False
