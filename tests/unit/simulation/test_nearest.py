"""The nearest obstacle, which is searched for within a short range first."""

from __future__ import annotations

import math

import pytest
from bot_console_robot.simulation.collisions import TOUCH_M
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.space import Space
from bot_console_robot.simulation.world_file import parse_world

RADIUS = 0.2
PILLAR = {"center": [9.0, 9.0], "radius": 0.1}


@pytest.fixture
def space() -> Space:
    data = {"size": [20, 20], "start": [10, 10, 0.0], "circles": [PILLAR]}
    return Space(parse_world("hall", data), [], Pose(10.0, 10.0, 0.0), RADIUS)


def test_nearest_obstacle_does_not_depend_on_earlier_queries(space: Space) -> None:
    beside, far_off = math.sqrt(2.0) - 0.1 - RADIUS, 4.0 - RADIUS
    for x, y, gap, what in [
        (10.0, 10.0, beside, "an obstacle"),
        (16.0, 10.0, far_off, "the boundary"),
        (10.0, 10.0, beside, "an obstacle"),
        (19.7, 10.0, 0.1, "the boundary"),
        (10.0, 10.0, beside, "an obstacle"),
    ]:
        found = space.nearest(x, y)
        assert (found[0], found[1]) == (pytest.approx(gap, abs=1e-6), what)


def test_no_obstacle_nearby_gives_infinity() -> None:
    world = parse_world("field", {"size": [40, 40], "start": [20, 20, 0.0]})
    space = Space(world, [], Pose(20.0, 20.0, 0.0), RADIUS)
    assert space.nearest(20.0, 20.0) == (math.inf, "")
    assert space.nearest(38.0, 20.0)[1] == "the boundary"
    assert space.nearest(20.0, 20.0) == (math.inf, "")


@pytest.mark.parametrize("speed", [0.3, 1.5])
def test_minimum_clearance_of_a_run_covers_every_step(speed: float) -> None:
    people = [{"radius": 0.3, "speed": 1.2, "keep_off": 0.05, "area": [1, 1, 7, 5]} for _ in range(3)]
    world = parse_world("hall", {"size": [8, 6], "start": [4, 3, 0.3], "moving": people})
    simulation = Simulation(world, 5)
    rooms: list[float] = []
    for step in range(500):
        simulation.command(speed, math.sin(step / 40))
        simulation.step()
        rooms.append(simulation.clearance)
        assert simulation.metrics.min_clearance == min(rooms)
        assert simulation.collisions.touching == (rooms[-1] < TOUCH_M)
