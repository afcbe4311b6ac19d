"""The plane of both velocities, with the requested and the actual velocity. Pure."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bot_console.tui.widgets.picture import Line, Piece, merged_line

Velocity = tuple[float, float]
ASKED, ROBOT, BOTH = "◌", "●", "◉"
TOP, BOTTOM, LEFT, RIGHT = "forward", "backward", "left", "right"


def plane(
    asked: Velocity | None, robot: Velocity | None, greatest: Velocity, size: tuple[int, int], *, moving: bool
) -> list[Line]:
    """Draw a frame around `size` cells, both odd: forward is up, a left turn is left, the corners are the limits.

    `moving` highlights the requested velocity, while the pane steers with it.
    """
    width, height = size
    across, down = width // 2, height // 2
    marks: dict[tuple[int, int], Piece] = {}
    for velocity, (mark, style) in ((asked, (ASKED, "accent" if moving else "strong")), (robot, (ROBOT, "good"))):
        if velocity is not None:
            cell = _cell(velocity, greatest, across, down)
            marks[cell] = (BOTH if cell in marks else mark, style)
    lines: list[Line] = [((f" ╭{TOP.center(width, '─')}╮", "dim"),)]
    for y in range(height):
        text = LEFT + "─" * (width - len(LEFT) - len(RIGHT)) + RIGHT if y == down else " " * width
        text = text[:across] + ("┼" if y == down else "│") + text[across + 1 :]
        cells: Sequence[Piece] = [marks.get((x, y), (character, "dim")) for x, character in enumerate(text)]
        lines.append(merged_line([(" ", "dim"), ("│", "dim"), *cells, ("│", "dim")]))
    return [*lines, ((f" ╰{BOTTOM.center(width, '─')}╯", "dim"),)]


def _cell(velocity: Velocity, greatest: Velocity, across: int, down: int) -> tuple[int, int]:
    """The column and the row of a velocity (m/s, rad/s); one beyond the limits is at the edge."""
    forward, left = (_share(*each) for each in zip(velocity, greatest, strict=True))
    return across - round(left * across), down - round(forward * down)


def _share(value: float, greatest: float) -> float:
    return max(-1.0, min(value / greatest, 1.0)) if greatest > 0 and not math.isnan(value) else 0.0


def velocity_at(lines: Sequence[str], x: int, y: int, greatest: Velocity) -> Velocity | None:
    """The velocity at a cell of a drawn plane; None outside it."""
    top = next((at for at, text in enumerate(lines) if f"{TOP}─" in text and "╭" in text), None)
    bottom = next((at for at, text in enumerate(lines) if f"{BOTTOM}─" in text and "╰" in text), None)
    if top is None or bottom is None:
        return None
    begin = lines[top].index("╭") + 1
    width, height = lines[top].index("╮") - begin, bottom - top - 1
    column, row, across, down = x - begin, y - top - 1, width // 2, height // 2
    if not (0 <= column < width and 0 <= row < height):
        return None
    return (down - row) / down * greatest[0], (across - column) / across * greatest[1]
