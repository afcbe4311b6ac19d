"""A small map of a picture that is larger than its window: where its items are, and which part is visible. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bot_console.tui.widgets.diagram.drawing import Place

EMPTY, LINK, BOX, CHOSEN = " ", "·", "▪", "●"
MAX_CELLS = (30, 9)
"""Maximum size of the map in cells."""
SHARE = 4
"""The map takes at most a quarter of the window's width and height."""
MIN_CELLS = (8, 3)


@dataclass(frozen=True)
class Window:
    """The visible part of a picture: its first cell and its size."""

    x: int
    y: int
    width: int
    height: int


def map_size(width: int, height: int, window: Window) -> tuple[int, int]:
    """Columns and lines of the map of a picture in a window; (0, 0) if it is not needed or has no room."""
    if width <= window.width and height <= window.height:
        return 0, 0
    columns, lines = min(MAX_CELLS[0], window.width // SHARE), min(MAX_CELLS[1], window.height // SHARE)
    columns, lines = min(columns, max(MIN_CELLS[0], width // 4)), min(lines, max(MIN_CELLS[1], height // 2))
    return (columns, lines) if columns >= MIN_CELLS[0] and lines >= MIN_CELLS[1] else (0, 0)


def map_lines(places: Mapping[str, Place], extent: tuple[int, int], size: tuple[int, int], selected: str) -> list[str]:
    """The lines of the map, one character per cell."""
    columns, lines = size
    cells = [[EMPTY] * columns for _ in range(lines)]
    order = (EMPTY, LINK, BOX, CHOSEN)
    for item, place in places.items():
        character = CHOSEN if item == selected else BOX if place.boxed else LINK
        x = min(columns - 1, (place.x + place.width // 2) * columns // max(1, extent[0]))
        y = min(lines - 1, (place.y + place.height // 2) * lines // max(1, extent[1]))
        cells[y][x] = max(cells[y][x], character, key=order.index)
    return ["".join(each) for each in cells]


def visible_part(extent: tuple[int, int], size: tuple[int, int], window: Window) -> tuple[range, range]:
    """The columns and lines of the map that represent the visible part."""
    columns, lines = size
    first = window.x * columns // max(1, extent[0])
    last = -(-(window.x + window.width) * columns // max(1, extent[0]))
    top = window.y * lines // max(1, extent[1])
    bottom = -(-(window.y + window.height) * lines // max(1, extent[1]))
    return range(first, min(columns, max(first + 1, last))), range(top, min(lines, max(top + 1, bottom)))
