"""Who frees the memory of the physics engine: its one owner, in plain steps, never the garbage collector.

pymunk frees with Python functions, which the collector runs in whatever thread it happens to be in, some of them called
back from C. An exception thrown into that thread (Ctrl-C, a node that is stopped) ends such a function half way; shapes
then stay in a space that is freed, and the next one to touch them dies of a segmentation fault. So these functions are
taken away from everything that is in a space; what an exception can still do is to leave some memory unfreed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pymunk
from bot_console_robot.simulation.engine import ffi, lib, pointer

_FREE: tuple[tuple[type[Any], Callable[[Any], None]], ...] = (
    (pymunk.Space, lib.cpSpaceFree),
    (pymunk.Body, lib.cpBodyFree),
    (pymunk.Shape, lib.cpShapeFree),
)


class EngineMemory:
    """What the engine holds for one space; `free` gives it back, after which none of it may be touched."""

    def __init__(self) -> None:
        self._held: list[tuple[Callable[[Any], None], Any]] = []

    def take(self, *items: pymunk.Space | pymunk.Body | pymunk.Shape) -> None:
        """Free these, the space first of all, when `free` is called and at no other time."""
        for item in items:
            held = pointer(item)
            ffi.gc(held, None)
            self._held.append((next(free for kind, free in _FREE if isinstance(item, kind)), held))

    def free(self) -> None:
        """Give everything back; a second call does nothing."""
        held, self._held = self._held, []
        for free, item in held:
            free(item)
