"""The physics engine below pymunk, for what is done in each step: pymunk's own layer costs more than the physics."""

from __future__ import annotations

from typing import Any

import pymunk

_engine: Any = __import__("pymunk._chipmunk_cffi", fromlist=["ffi", "lib"])
ffi, lib = _engine.ffi, _engine.lib


def pointer(item: pymunk.Space | pymunk.Body | pymunk.Shape) -> Any:
    """Where the engine has an object of pymunk; the same in all of pymunk 7."""
    name = "_space" if isinstance(item, pymunk.Space) else "_body" if isinstance(item, pymunk.Body) else "_shape"
    return getattr(item, name)


class Body:
    """A body of a space, in m, rad and s; it may not be used when the space is gone."""

    __slots__ = ("_pointer", "_vector")

    def __init__(self, body: pymunk.Body) -> None:
        self._pointer = pointer(body)
        self._vector = ffi.new("cpVect *")

    def move(self, x: float, y: float, vx: float, vy: float) -> None:
        """Let the next step begin at a place, with a velocity."""
        vector = self._vector
        vector.x, vector.y = x, y
        lib.cpBodySetPosition(self._pointer, vector[0])
        vector.x, vector.y = vx, vy
        lib.cpBodySetVelocity(self._pointer, vector[0])

    def push(self, x: float, y: float, torque: float) -> None:
        """A force in N and a torque in Nm for the next step alone."""
        vector = self._vector
        vector.x, vector.y = x, y
        lib.cpBodySetForce(self._pointer, vector[0])
        lib.cpBodySetTorque(self._pointer, torque)

    def pose(self) -> tuple[float, float, float]:
        """x, y, and the angle, which goes on growing beyond a turn."""
        place = lib.cpBodyGetPosition(self._pointer)
        return place.x, place.y, lib.cpBodyGetAngle(self._pointer)

    def velocity(self) -> tuple[float, float, float]:
        """Along x, along y, and of the angle."""
        velocity = lib.cpBodyGetVelocity(self._pointer)
        return velocity.x, velocity.y, lib.cpBodyGetAngularVelocity(self._pointer)
