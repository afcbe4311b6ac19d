"""Pixels as text: coloured half-blocks (two pixels per cell) or characters for greys, and what these cost. Pure."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.sensors.camera_image import Picture
from bot_console.tui.widgets.picture import Line, merged_line

Pixels = npt.NDArray[np.uint8]

COLOUR_LEVELS = 16
"""Levels of each colour channel: fewer colours make longer runs of the same one, and so fewer bytes."""
MAX_NOISE = 14
"""A pixel is not redrawn while every colour differs by less than this plus one level, so that noise costs nothing."""
RAMP = " .:-=+*#%@"
"""Characters from black to white, for terminals without colours or half-blocks."""
COLOUR_BYTES, CHARACTER_BYTES = 18, 3
"""Bytes to change one of the two colours of a cell, and of a half-block character."""


def pixels_of(picture: Picture) -> Pixels:
    """The pixels of a picture as an array (rows, columns, 3), with an even number of rows."""
    flat: Any = np.frombuffer(picture.pixels, np.uint8)
    found: Pixels = flat.reshape(picture.rows, picture.columns, 3)
    return np.concatenate([found, np.zeros_like(found[:1])]) if picture.rows % 2 else found


def steady(new: Pixels, shown: Pixels | None) -> Pixels:
    """The pixels to show: those that have hardly changed stay exactly the same, the others get reduced colours."""
    few = (new // (256 // COLOUR_LEVELS) * (255 // (COLOUR_LEVELS - 1))).astype(np.uint8)
    if shown is None or shown.shape != new.shape:
        return few
    distance: npt.NDArray[np.int16] = np.abs(new.astype(np.int16) - shown.astype(np.int16)).max(axis=2)
    return np.where(distance[:, :, np.newaxis] >= MAX_NOISE + 256 // COLOUR_LEVELS, few, shown).astype(np.uint8)


def half_blocks(pixels: Pixels, width: int, height: int) -> list[Line]:
    """Lines of half-blocks, centred in `width` x `height` cells."""
    packed = pixels.astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], np.uint32)
    lines = [
        merged_line([_cell(*pair) for pair in zip(top, below, strict=True)])
        for top, below in zip(packed[::2].tolist(), packed[1::2].tolist(), strict=True)
    ]
    return _in_the_middle(lines, pixels.shape[1], width, height)


def characters(pixels: Pixels, width: int, height: int) -> list[Line]:
    """Lines of grey-scale characters, centred in `width` x `height` cells."""
    light = pixels.astype(np.float32) @ np.array([0.299, 0.587, 0.114], np.float32)
    places = ((light[::2] + light[1::2]) / 2 / 256 * len(RAMP)).astype(int)
    lines: list[Line] = [(("".join(RAMP[each] for each in row), ""),) for row in places.tolist()]
    return _in_the_middle(lines, pixels.shape[1], width, height)


def cost(new: Pixels, shown: Pixels | None, *, coloured: bool) -> int:
    """Estimate how many bytes it takes to show the pixels `new` where `shown` is on the screen."""
    same = shown is not None and shown.shape == new.shape
    changed = (new != shown).any(axis=2) if same and shown is not None else np.ones(new.shape[:2], bool)
    cells = changed[::2] | changed[1::2]
    if not coloured:
        return int(cells.sum())
    other = np.ones(new.shape[:2], bool)
    other[:, 1:] = (new[:, 1:] != new[:, :-1]).any(axis=2)
    grounds = other[::2].astype(int) + other[1::2].astype(int)
    return int((cells * (CHARACTER_BYTES + COLOUR_BYTES * grounds)).sum())


def _cell(top: int, below: int) -> tuple[str, str]:
    return (" ", f"on #{top:06x}") if top == below else ("▀", f"#{top:06x} on #{below:06x}")


def _in_the_middle(lines: list[Line], across: int, width: int, height: int) -> list[Line]:
    left, top = max(0, width - across) // 2, max(0, height - len(lines)) // 2
    blank: Line = ((" " * width, ""),)
    shifted = [((" " * left, ""), *line) for line in lines]
    return [blank] * top + shifted + [blank] * (height - top - len(lines))
