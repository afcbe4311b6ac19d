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


# What each step calls, looked up once and called as it is: a layer in between would cost as much again. All take what
# `pointer` gives, which may not be used when the space is gone. A vector goes in as a tuple, and has `x` and `y`.
set_position: Any = lib.cpBodySetPosition
set_velocity: Any = lib.cpBodySetVelocity
set_force: Any = lib.cpBodySetForce
"""For the next step alone, in N; as the torque, in Nm."""
set_torque: Any = lib.cpBodySetTorque
position: Any = lib.cpBodyGetPosition
angle: Any = lib.cpBodyGetAngle
"""In rad; goes on growing beyond a turn."""
velocity: Any = lib.cpBodyGetVelocity
turn_rate: Any = lib.cpBodyGetAngularVelocity
step: Any = lib.cpSpaceStep
"""Let s pass in a space."""
