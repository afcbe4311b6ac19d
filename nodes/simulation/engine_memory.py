"""Lets the owner free the memory of the physics engine explicitly, instead of the garbage collector.

pymunk frees memory in Python functions that the collector runs in an arbitrary thread, some of them called back from C.
An exception raised in that thread (Ctrl-C, a node being stopped) aborts such a function half way. Shapes then remain in
a freed space, and the next access to them is a segmentation fault. Therefore these finalizers are detached from
everything in a space, so that an exception can at worst leave some memory unfreed.
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
    """The engine's objects of one space; `free` releases them, after which none of them may be used."""

    def __init__(self) -> None:
        self._held: list[tuple[Callable[[Any], None], Any]] = []

    def take(self, *items: pymunk.Space | pymunk.Body | pymunk.Shape) -> None:
        """Take ownership of objects, of the space first; only `free` frees them."""
        for item in items:
            held = pointer(item)
            ffi.gc(held, None)
            self._held.append((next(free for kind, free in _FREE if isinstance(item, kind)), held))

    def free(self) -> None:
        """Free everything; a second call does nothing."""
        held, self._held = self._held, []
        for free, item in held:
            free(item)
