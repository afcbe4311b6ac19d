"""The map of the world as lines of braille. Pure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.robot.robot_model import GridMap, Pose, WorldInfo
from bot_console.tui.widgets.braille import BrailleCanvas, layered
from bot_console.tui.widgets.picture import Line, Piece

OCCUPIED_PERCENT = 50
"""Minimum occupancy (percent) of a grid cell that counts as a wall."""

UNKNOWN = 255
ARROWS = "→↗↑↖←↙↓↘"


@dataclass(frozen=True)
class Window:
    """The visible part of the world: the centre (m) and dots per metre."""

    x: float
    y: float
    scale: float


def fitting_window(world: WorldInfo, width: int, height: int) -> Window:
    """The window that shows the whole map, or 10 m around the robot if there is none."""
    grid = world.map
    if grid is None:
        pose = world.pose or Pose()
        return Window(pose.x, pose.y, min(width * 2, height * 4) / 10.0)
    across, down = grid.width * grid.resolution, grid.height * grid.resolution
    scale = min((width * 2 - 2) / across, (height * 4 - 2) / down)
    return Window(grid.origin.x + across / 2, grid.origin.y + down / 2, scale)


def following_window(world: WorldInfo, width: int, height: int, zoom: float) -> Window:
    """A window around the robot, magnified `zoom` times compared with the one that shows everything."""
    whole = fitting_window(world, width, height)
    pose = world.pose
    return whole if pose is None or zoom <= 1 else Window(pose.x, pose.y, whole.scale * zoom)


class WorldDrawing:
    """Draws a world; the walls are cached while map and window stay the same."""

    def __init__(self) -> None:
        self._key: object = None
        self._walls: npt.NDArray[np.bool_] | None = None

    def rows(self, world: WorldInfo, window: Window, width: int, height: int) -> list[Line]:
        """Walls, trail, LIDAR hits, goal, and the robot as an arrow."""
        walls, trail, hits = (BrailleCanvas(width, height) for _ in range(3))
        if world.map is not None:
            walls.mask(self._wall_dots(world.map, window, width, height))
        for points, canvas in ((world.trail, trail), (world.hits, hits)):
            if points:
                canvas.points(*_dots(np.asarray(points, float), window, width, height))
        layers = [hits.codes(), trail.codes(), walls.codes()]
        rows = layered(layers, ("warn", "accent", ""), width, height)
        for (column, row), character, style in _characters(world, window, width, height):
            if 0 <= row < height and 0 <= column < width:
                rows[row] = _with_character(rows[row], column, character, style)
        return [tuple(row) for row in rows]

    def _wall_dots(self, grid: GridMap, window: Window, width: int, height: int) -> npt.NDArray[np.bool_]:
        key = (id(grid), window, width, height)
        if key != self._key or self._walls is None:
            self._key = key
            self._walls = _sample(grid, window, width, height)
        return self._walls


def _sample(grid: GridMap, window: Window, width: int, height: int) -> npt.NDArray[np.bool_]:
    """The dots that show a wall: those with at least one occupied grid cell below them."""
    flat: Any = np.frombuffer(grid.cells, np.uint8)
    cells: npt.NDArray[np.uint8] = flat.reshape(grid.height, grid.width)
    rows, columns = np.nonzero((cells >= OCCUPIED_PERCENT) & (cells != UNKNOWN))
    picture = np.zeros((height * 4, width * 2), np.bool_)
    reach = max(1, math.ceil(grid.resolution * window.scale))
    steps = (np.arange(reach) + 0.5) / reach
    for down in steps:
        for across in steps:
            x = grid.origin.x + (columns + across) * grid.resolution
            y = grid.origin.y + (rows + down) * grid.resolution
            column, row = _dots(np.stack([x, y], axis=1), window, width, height)
            inside = (column >= 0) & (column < width * 2) & (row >= 0) & (row < height * 4)
            picture[row[inside].astype(int), column[inside].astype(int)] = True
    return picture


def _dots(
    points: npt.NDArray[np.float64], window: Window, width: int, height: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    x = width + (points[:, 0] - window.x) * window.scale
    y = height * 2 - (points[:, 1] - window.y) * window.scale
    return np.floor(x), np.floor(y)


def _with_character(pieces: list[Piece], column: int, character: str, style: str) -> list[Piece]:
    """A row in which one character is replaced."""
    result: list[Piece] = []
    at = 0
    for text, name in pieces:
        inside = column - at
        if 0 <= inside < len(text):
            result += [(text[:inside], name), (character, style), (text[inside + 1 :], name)]
        else:
            result.append((text, name))
        at += len(text)
    return [each for each in result if each[0]]


def visible_content(world: WorldInfo, window: Window, width: int, height: int) -> object:
    """A token for what a drawing shows: worlds with equal tokens look the same, even if the robot moved a little."""
    return world.map, world.hits, world.trail, window, width, height, _characters(world, window, width, height)


def _characters(world: WorldInfo, window: Window, width: int, height: int) -> list[tuple[tuple[int, int], str, str]]:
    """The characters for goal and robot, each with the column and row of its cell, and its style."""
    characters: list[tuple[tuple[int, int], str, str]] = []
    if world.goal is not None:
        characters.append((_cell(*world.goal, window, width, height), "✚", "good"))
    if world.pose is not None:
        pose = world.pose
        characters.append((_cell(pose.x, pose.y, window, width, height), arrow(pose.heading), "robot"))
    return characters


def _cell(x: float, y: float, window: Window, width: int, height: int) -> tuple[int, int]:
    column, row = _dots(np.array([[x, y]]), window, width, height)
    return int(column[0]) // 2, int(row[0]) // 4


def arrow(heading: float) -> str:
    """The arrow nearest to a heading (rad)."""
    return ARROWS[round(heading / (math.pi / 4)) % 8] if math.isfinite(heading) else "?"


def scale_text(window: Window, width: int, room: int | None = None) -> str:
    """A scale bar of about a fifth of the width with its length in metres, or a shorter one that fits into `room`."""
    metres = width * 2 / 5 / window.scale
    power = 10.0 ** math.floor(math.log10(metres)) if metres > 0 else 1.0
    lengths = [each * power for each in (5, 2, 1, 0.5, 0.2, 0.1) if each * power <= metres] or [power]
    bars = [_bar(length, window) for length in lengths]
    return next((each for each in bars if room is None or len(each) <= room), "")


def _bar(length: float, window: Window) -> str:
    cells = max(1, round(length * window.scale / 2))
    return f"├{'─' * max(0, cells - 2)}┤ {length:g} m"
