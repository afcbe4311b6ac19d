"""Finds the shortest path on an occupancy grid that keeps clear of obstacles."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

OCCUPIED_PERCENT = 50
"""Occupancy in percent at and above which a cell is blocked; unknown cells (-1) are blocked too."""
PLANNING_CELL_M = 0.1
"""Cell size in m of the grid used for planning."""
COMFORT_MARGIN_M = 0.3
"""Distance in m beyond the clearance within which a path costs more."""
NEIGHBOURS = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))

Point = tuple[float, float]
Cell = tuple[int, int]


class NoPath(Exception):
    """There is no path; the message says why."""


@dataclass(frozen=True)
class Grid:
    """An occupancy grid: rows from the lower left, the cell size and the position of its corner (m)."""

    cells: npt.NDArray[np.int8]
    resolution: float
    origin: Point


class Planner:
    """Plans paths for a robot that needs `clearance` m on each side of its centre."""

    def __init__(self, grid: Grid, clearance: float) -> None:
        self._origin = grid.origin
        self._step = max(PLANNING_CELL_M, grid.resolution)
        taken = _coarse(grid, self._step)
        self._blocked = _grown(taken, clearance / self._step)
        near = _grown(taken, (clearance + COMFORT_MARGIN_M) / self._step)
        self._cost: npt.NDArray[np.float64] = np.where(near, 3.0, 1.0)

    def plan(self, start: Point, goal: Point) -> list[Point]:
        """Return the points (m) of a path to the goal, without the start; raises `NoPath`."""
        if not all(map(math.isfinite, (*start, *goal))):
            raise NoPath("a position is not a finite number")
        first, last = self._free_near(start, "the robot"), self._free_near(goal, "the goal")
        cells = self._search(first, last)
        if cells is None:
            raise NoPath(f"x = {goal[0]:.2f} m, y = {goal[1]:.2f} m is enclosed by walls")
        places = [self._place(each) for each in self._straightened(cells)][1:]
        return [*places[:-1], goal] if self._cell(goal) == last else places

    def _cell(self, point: Point) -> Cell:
        column, row = ((at - corner) / self._step for at, corner in zip(point, self._origin, strict=True))
        return math.floor(row), math.floor(column)

    def _place(self, cell: Cell) -> Point:
        row, column = cell
        return self._origin[0] + (column + 0.5) * self._step, self._origin[1] + (row + 0.5) * self._step

    def _free(self, cell: Cell) -> bool:
        rows, columns = self._blocked.shape
        return 0 <= cell[0] < rows and 0 <= cell[1] < columns and not self._blocked[cell]

    def _free_near(self, point: Point, what: str) -> Cell:
        """Return the free cell nearest to a point, within half a metre: a robot may be too close to a wall."""
        row, column = self._cell(point)
        reach = math.ceil(0.5 / self._step)
        around = [(row + r, column + c) for r in range(-reach, reach + 1) for c in range(-reach, reach + 1)]
        free = [each for each in around if self._free(each)]
        if not free:
            raise NoPath(f"{what} is inside a wall or outside the map: x = {point[0]:.2f} m, y = {point[1]:.2f} m")
        return min(free, key=lambda each: math.dist(each, (row, column)))

    def _search(self, first: Cell, last: Cell) -> list[Cell] | None:
        """A* over eight neighbours; diagonal moves do not cut corners."""
        known: dict[Cell, float] = {first: 0.0}
        came: dict[Cell, Cell] = {}
        waiting: list[tuple[float, Cell]] = [(0.0, first)]
        done: set[Cell] = set()
        while waiting:
            _, cell = heapq.heappop(waiting)
            if cell == last:
                return _traced(came, cell)
            if cell in done:
                continue
            done.add(cell)
            for after, length in self._around(cell):
                cost = known[cell] + length * float(self._cost[after])
                if cost < known.get(after, math.inf):
                    known[after] = cost
                    came[after] = cell
                    heapq.heappush(waiting, (cost + math.dist(after, last), after))
        return None

    def _around(self, cell: Cell) -> Iterator[tuple[Cell, float]]:
        row, column = cell
        for down, across in NEIGHBOURS:
            after = row + down, column + across
            diagonal = bool(down and across)
            if self._free(after) and not (
                diagonal and not (self._free((row + down, column)) and self._free((row, column + across)))
            ):
                yield after, math.sqrt(2.0) if diagonal else 1.0

    def _straightened(self, cells: list[Cell]) -> list[Cell]:
        """Return the corners of a path, without intermediate points that have a direct line of sight."""
        kept, at = [cells[0]], 0
        while at < len(cells) - 1:
            after = len(cells) - 1
            while after > at + 1 and not self._sees(cells[at], cells[after]):
                after -= 1
            at = after
            kept.append(cells[at])
        return kept

    def _sees(self, a: Cell, b: Cell) -> bool:
        """Whether all cells between two are free, and none costs more than both of them."""
        count = 2 * max(abs(a[0] - b[0]), abs(a[1] - b[1])) + 1
        rows = np.rint(np.linspace(a[0], b[0], count)).astype(int)
        columns = np.rint(np.linspace(a[1], b[1], count)).astype(int)
        dearest = max(float(self._cost[a]), float(self._cost[b]))
        return not bool(self._blocked[rows, columns].any()) and float(self._cost[rows, columns].max()) <= dearest


def _traced(came: dict[Cell, Cell], cell: Cell) -> list[Cell]:
    way = [cell]
    while cell in came:
        cell = came[cell]
        way.append(cell)
    return way[::-1]


def _coarse(grid: Grid, step: float) -> npt.NDArray[np.bool_]:
    """Return which cells of size `step` are occupied."""
    taken = (grid.cells >= OCCUPIED_PERCENT) | (grid.cells < 0)
    rows, columns = (math.ceil(length * grid.resolution / step) for length in taken.shape)
    result = np.zeros((max(rows, 1), max(columns, 1)), np.bool_)
    found: npt.NDArray[np.intp] = np.argwhere(taken)
    at = np.floor((found + 0.5) * grid.resolution / step).astype(int)
    result[at[:, 0], at[:, 1]] = True
    return result


def _grown(taken: npt.NDArray[np.bool_], reach: float) -> npt.NDArray[np.bool_]:
    """Return the occupied cells and all within `reach` cells of them; the edge of the grid counts as occupied."""
    cells = math.ceil(reach)
    padded = np.pad(taken, cells, constant_values=True)
    result = np.zeros_like(taken)
    rows, columns = taken.shape
    for down in range(-cells, cells + 1):
        for across in range(-cells, cells + 1):
            if math.hypot(down, across) <= reach:
                result |= padded[cells + down : cells + down + rows, cells + across : cells + across + columns]
    return result
