"""A world as an occupancy grid, as in `nav_msgs/OccupancyGrid`."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from bot_console_robot.simulation.arrays import Floats
from bot_console_robot.simulation.geometry import Point
from bot_console_robot.simulation.world import World

FREE, OCCUPIED, UNKNOWN = 0, 100, -1


def occupancy_grid(world: World, resolution: float) -> npt.NDArray[np.int8]:
    """Return cells of `resolution` m, rows from the lower left: 100 for static obstacles, -1 outside."""
    columns, rows = (math.ceil(length / resolution) for length in world.size)
    xs: Floats = (np.arange(columns, dtype=np.float64) + 0.5) * resolution
    ys: Floats = (np.arange(rows, dtype=np.float64) + 0.5) * resolution
    grid = np.where(_inside(world.boundary, xs, ys), FREE, UNKNOWN).astype(np.int8)
    for block in world.blocks:
        grid[_inside(block.points, xs, ys)] = OCCUPIED
    for disc in world.discs:
        reach = max(disc.radius, 0.5 * resolution)
        grid[np.hypot(xs[None, :] - disc.x, ys[:, None] - disc.y) <= reach] = OCCUPIED
    for a, b, _ in world.edges():
        _draw(grid, a, b, resolution)
    return grid


def _inside(outline: tuple[Point, ...], xs: Floats, ys: Floats) -> npt.NDArray[np.bool_]:
    """Return which cell centres lie within an outline (even-odd rule)."""
    hit = np.zeros((len(ys), len(xs)), np.bool_)
    y = ys[:, None]
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1], strict=True):
        if ay == by:
            continue
        crosses = (ay > y) != (by > y)
        hit ^= crosses & (xs[None, :] < ax + (bx - ax) * (y - ay) / (by - ay))
    return hit


def _draw(grid: npt.NDArray[np.int8], a: Point, b: Point, resolution: float) -> None:
    """Mark the cells along a line, sampled twice per cell."""
    count = max(2, math.ceil(2 * math.dist(a, b) / resolution) + 1)
    columns = (np.linspace(a[0], b[0], count) / resolution).astype(np.int64)
    rows = (np.linspace(a[1], b[1], count) / resolution).astype(np.int64)
    grid[np.minimum(rows, grid.shape[0] - 1), np.minimum(columns, grid.shape[1] - 1)] = OCCUPIED
