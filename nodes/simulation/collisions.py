"""Collisions as events: one contact is one event, no matter how long the robot scrapes along."""

from __future__ import annotations

from dataclasses import dataclass

TOUCH_M = 0.003
"""A gap in m below which the robot touches; pymunk lets bodies overlap by about 1 mm."""
SAME_COLLISION_S = 0.5
"""Seconds without contact after which the next contact is a new collision."""


@dataclass(frozen=True, slots=True)
class Collision:
    """A contact that began at `time` (s), at `speed` (m/s), with a kind of object (`a wall` ...)."""

    time: float
    x: float
    y: float
    speed: float
    what: str


class CollisionLog:
    """Detects collisions from the gaps to obstacles over time; keeps their count and the latest one."""

    def __init__(self) -> None:
        self.count = 0
        self.last: Collision | None = None
        self.touching = False
        self._last_touch = -SAME_COLLISION_S

    def update(self, time: float, gap: float, x: float, y: float, speed: float, what: str) -> bool:
        """Record the gap in m at a time in s; returns whether a new collision began."""
        self.touching = gap < TOUCH_M
        if not self.touching:
            return False
        began = time - self._last_touch >= SAME_COLLISION_S
        self._last_touch = time
        if began:
            self.count += 1
            self.last = Collision(time, x, y, speed, what)
        return began
