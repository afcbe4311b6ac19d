"""A turtlesim field as lines of braille, in the colours with which the turtles have drawn. Pure."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.robot.robot_model import Drawing, Turtle, TurtleField
from bot_console.tui.panes.world.map_drawing import arrow
from bot_console.tui.widgets.braille import BITS
from bot_console.tui.widgets.picture import Line, merged_line

SIDE_M = 499 / 45
"""Width and height of a field (m)."""
PEN, BACKGROUND = 0xB3B8FF, 0x4556FF
"""Colours of a trail and of the background if the drawing is unknown: turtlesim's defaults."""
SIDE_PX = 500
"""Width and height of a drawing made from trails."""

Cell = tuple[str, str]


class FieldDrawing:
    """Draws a field; the turtles' drawing is cached while it and the size stay the same."""

    def __init__(self) -> None:
        self._key: object = None
        self._cells: list[list[Cell]] = []

    def rows(self, field: TurtleField, width: int, height: int) -> list[Line]:
        """The drawing with an arrow for each turtle, and the names if there are several."""
        drawing = field.drawing or _drawing_from_trails(field)
        key = (drawing.pixels if field.drawing is None else id(drawing), width, height)
        if key != self._key:
            self._key = key
            self._kept = drawing  # keeps the object alive whose id is part of the key
            self._cells = _cells(drawing, width, height)
        cells = [list(row) for row in self._cells]
        for turtle in field.turtles:
            _put(cells, turtle, width, height, with_name=len(field.turtles) > 1)
        return [merged_line(row) for row in cells]


def _drawing_from_trails(field: TurtleField) -> Drawing:
    """A drawing made from the trails of the turtles."""
    pixels = np.zeros((SIDE_PX, SIDE_PX, 4), np.uint8)
    pixels[:] = (*BACKGROUND.to_bytes(3, "big"), 0)
    scale = (SIDE_PX - 1) / SIDE_M
    for turtle in field.turtles:
        for x, y in turtle.trail:
            column, row = (min(max(round(each * scale), 0), SIDE_PX - 1) for each in (x, y))
            pixels[SIDE_PX - 1 - row, column] = (*PEN.to_bytes(3, "big"), 255)
    return Drawing(SIDE_PX, SIDE_PX, pixels.tobytes())


def _size(width: int, height: int) -> tuple[int, int, int, int]:
    """First column, first row, columns and rows of a square field, as a cell is twice as high as it is wide."""
    down = min(height, width // 2)
    across = min(width, down * 2)
    return (width - across) // 2, (height - down) // 2, across, down


def _cells(drawing: Drawing, width: int, height: int) -> list[list[Cell]]:
    flat: Any = np.frombuffer(drawing.pixels, np.uint8)
    pixels: npt.NDArray[np.uint8] = flat.reshape(drawing.height, drawing.width, 4)
    left, top, across, down = _size(width, height)
    rows, columns = np.nonzero(pixels[:, :, 3])
    column, row = columns * across * 2 // drawing.width, rows * down * 4 // drawing.height
    codes = np.zeros((down, across), np.uint8)
    np.bitwise_or.at(codes, (row // 4, column // 2), BITS[row % 4, column % 2])
    packed = pixels[:, :, :3].astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], np.uint32)
    colors = np.zeros((down, across), np.uint32)
    colors[row // 4, column // 2] = packed[rows, columns]
    empty = np.argwhere(pixels[:, :, 3] == 0)
    behind = int(packed[tuple(empty[0])]) if len(empty) else BACKGROUND
    field = [
        [_cell(*pair, behind) for pair in zip(*each, strict=True)]
        for each in zip(codes.tolist(), colors.tolist(), strict=True)
    ]
    before, after = [(" ", "")] * left, [(" ", "")] * (width - left - across)
    blank = [(" ", "")] * width
    return [blank] * top + [before + row + after for row in field] + [blank] * (height - top - down)


def _cell(code: int, color: int, behind: int) -> Cell:
    return (chr(0x2800 + code), f"#{color:06x} on #{behind:06x}") if code else (" ", f"on #{behind:06x}")


def _put(cells: list[list[Cell]], turtle: Turtle, width: int, height: int, *, with_name: bool) -> None:
    left, top, across, down = _size(width, height)
    column = left + min(max(int(turtle.pose.x / SIDE_M * across), 0), across - 1)
    row = top + min(max(int((1.0 - turtle.pose.y / SIDE_M) * down), 0), down - 1)
    cells[row][column] = (arrow(turtle.pose.heading), "robot")
    if with_name:
        for at, character in enumerate(turtle.name[: left + across - column - 1], column + 1):
            behind = cells[row][at][1].rpartition("on #")[2]
            light = sum(bytes.fromhex(behind)) > 3 * 128
            cells[row][at] = (character, f"bold #{'000000' if light else 'ffffff'} on #{behind}")
