"""Calls the physics engine below pymunk in each step, because pymunk's own layer costs more than the physics.

This uses two private parts of pymunk on purpose: the module `_chipmunk_cffi`, which contains the C functions of the
engine, and the attributes `_space`, `_body` and `_shape`, which hold the C objects. The public properties of pymunk
convert every vector and check every argument, which takes longer than the step itself. `pyproject.toml`
limits pymunk to the releases (7.x) that have these names. Everything that is set up once, such as bodies and shapes,
uses the public interface.
"""

from __future__ import annotations

from typing import Any

import pymunk

# Private modules have no type information; importing it by name keeps the type checker from asking for it.
_engine: Any = __import__("pymunk._chipmunk_cffi", fromlist=["ffi", "lib"])
ffi, lib = _engine.ffi, _engine.lib


def pointer(item: pymunk.Space | pymunk.Body | pymunk.Shape) -> Any:
    """Return the engine's pointer to a pymunk object; valid for every release of pymunk 7."""
    name = "_space" if isinstance(item, pymunk.Space) else "_body" if isinstance(item, pymunk.Body) else "_shape"
    return getattr(item, name)


# The functions called in every step, looked up once and called directly, since a wrapper would double their cost. All
# take the result of `pointer`, which must not be used after the space has been freed. A vector is passed as a tuple,
# and returned as an object with `x` and `y`.
set_position: Any = lib.cpBodySetPosition
set_velocity: Any = lib.cpBodySetVelocity
set_force: Any = lib.cpBodySetForce
"""Set the force (N) for the next step only; `set_torque` does the same for the torque (Nm)."""
set_torque: Any = lib.cpBodySetTorque
position: Any = lib.cpBodyGetPosition
angle: Any = lib.cpBodyGetAngle
"""The angle (rad), which keeps growing beyond a full turn."""
velocity: Any = lib.cpBodyGetVelocity
turn_rate: Any = lib.cpBodyGetAngularVelocity
step: Any = lib.cpSpaceStep
"""Advance a space by this many seconds."""
