"""The physics engine's memory is freed by its owner: no Python function of pymunk's runs in the garbage collector."""

from __future__ import annotations

import gc
import sys
import weakref
from types import FrameType

from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world import World

FREEING = {
    "spacefree", "freebody", "shapefree",
    "ext_cpSpaceShapeIteratorFunc", "ext_cpSpaceBodyIteratorFunc", "ext_cpBodyShapeIteratorFunc",
}  # fmt: skip


def test_the_collector_frees_no_physics(room: World) -> None:
    called: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and "pymunk" in frame.f_code.co_filename:
            called.append(frame.f_code.co_name)

    simulation = Simulation(room, 1)
    simulation.step()
    cycle: list[object] = [simulation]
    cycle.append(cycle)
    gone = weakref.ref(simulation)
    gc.collect()
    sys.setprofile(note)
    try:
        del simulation, cycle
        gc.collect()
    finally:
        sys.setprofile(None)
    assert gone() is None
    assert not FREEING & set(called)


def test_what_is_freed_twice_is_freed_once(room: World) -> None:
    simulation = Simulation(room, 1)
    memory = simulation._space._memory
    memory.free()
    memory.free()
    del simulation
    gc.collect()
