"""The physics engine's memory is freed by its owner: no Python function of pymunk runs in the garbage collector."""

from __future__ import annotations

import gc
import subprocess
import sys

import pytest
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world import World

COLLECTED = """
import gc, sys, weakref
from bot_console.runtime.importer import install
install()
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world_file import parse_world

called = []
circle = {"center": [4.0, 2.0], "radius": 0.5}
room = {"size": [6.0, 4.0], "start": [1.0, 2.0, 0.0], "circles": [circle]}
simulation = Simulation(parse_world("room", room), 1)
simulation.step()
cycle = [simulation]
cycle.append(cycle)
gone = weakref.ref(simulation)
gc.collect()
sys.setprofile(lambda frame, event, _: event == "call" and called.append(frame.f_code))
del simulation, cycle
gc.collect()
sys.setprofile(None)
assert gone() is None
print(*(code.co_name for code in called if "pymunk" in code.co_filename))
"""
"""Runs in a separate process: CPython 3.11 can hang in a profiled frame while a thread has a pending exception."""
FREEING = {
    "spacefree", "freebody", "shapefree",
    "ext_cpSpaceShapeIteratorFunc", "ext_cpSpaceBodyIteratorFunc", "ext_cpBodyShapeIteratorFunc",
}  # fmt: skip


def test_garbage_collector_frees_no_physics() -> None:
    done = subprocess.run([sys.executable, "-c", COLLECTED], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not FREEING & set(done.stdout.split())


@pytest.mark.slow
def test_freeing_twice_is_harmless(room: World) -> None:
    simulation = Simulation(room, 1)
    memory = simulation._space._memory
    memory.free()
    memory.free()
    del simulation
    gc.collect()
