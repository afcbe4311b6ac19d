from dataclasses import replace

import numpy as np
import pytest
from bot_console_robot.simulation.occupancy import FREE, OCCUPIED, UNKNOWN, occupancy_grid
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation.world_file import parse_world


def test_rows_start_at_the_lower_left() -> None:
    world = parse_world(
        "w", {"size": [4, 2], "start": [1, 1, 0], "boxes": [{"center": [3.5, 0.5], "size": [0.5, 0.5]}]}
    )
    grid = occupancy_grid(world, 0.1)
    assert grid.shape == (20, 40)
    assert grid.dtype == np.int8
    assert grid[5, 35] == OCCUPIED
    assert grid[15, 35] == FREE
    assert grid[5, 5] == FREE
    assert (grid[0] == OCCUPIED).all()
    assert (grid[:, -1] == OCCUPIED).all()


def test_outside_a_rounded_boundary_is_unknown() -> None:
    grid = occupancy_grid(parse_world("w", {"size": [4, 4], "start": [2, 2, 0], "boundary": 1.0}), 0.1)
    assert grid[0, 0] == grid[-1, -1] == UNKNOWN
    assert grid[20, 20] == FREE


@pytest.mark.parametrize("resolution", [0.05, 0.2])
def test_cell_is_occupied_exactly_where_an_obstacle_is(shipped_world: World, resolution: float) -> None:
    simulation = Simulation(replace(shipped_world, movers=()), 1)
    grid = occupancy_grid(simulation.world, resolution)
    rng = np.random.default_rng(5)
    radius = simulation.drive.limits.radius
    for _ in range(400):
        x, y = rng.uniform(0, shipped_world.size[0]), rng.uniform(0, shipped_world.size[1])
        gap = simulation.gap_at(x, y) + radius
        cell = grid[int(y / resolution), int(x / resolution)]
        if gap == -np.inf:
            assert cell in (UNKNOWN, OCCUPIED)
        elif cell == OCCUPIED:
            assert gap < 1.5 * resolution
        elif gap < 0.0:
            assert gap > -1.5 * resolution
