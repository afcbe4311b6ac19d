"""The meaning of a mouse position on the steering pane: a slider's velocity, both velocities, or a button. Pure."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.panes.steering.plane import velocity_at
from bot_console.tui.panes.steering.view import BUTTONS
from bot_console.tui.widgets.picture import Line


def button(lines: Sequence[Line], x: int, y: int) -> tuple[int, int] | None:
    """The axis (0 linear, 1 angular) and step (1 faster or left, 0 zero, -1 slower or right) of the button at a cell;
    None if there is none.
    """
    text = "".join(text for text, _ in lines[y]) if 0 <= y < len(lines) else ""
    for axis, (word, (less, zero, more)) in enumerate(BUTTONS.items()):
        begin = text.rfind(less)
        if begin < 0 or not text.startswith(f" {word} ") or not begin <= x < len(text):
            continue
        which = (x - begin) // 4
        step = (-1, 0, 1)[which] if (x - begin) % 4 < len((less, zero, more)[which]) else None
        return None if step is None else (axis, -step if axis else step)
    return None


def velocities(
    lines: Sequence[Line], x: int, y: int, greatest: tuple[float, float]
) -> tuple[float | None, float | None, bool] | None:
    """Linear and angular velocity (m/s, rad/s; None: unchanged) at a cell, and whether it is on the pad; None
    elsewhere.
    """
    texts = ["".join(text for text, _ in line) for line in lines]
    if not 0 <= y < len(texts):
        return None
    for word, axis in (("linear", 0), ("angular", 1)):
        if texts[y].startswith(f" {word} "):
            start, end = texts[y].find("├") + 1, texts[y].find("┤")
            if not 0 < start <= x < end:
                return None
            share = 2 * (x - start) / max(1, end - start - 1) - 1
            return (share * greatest[0], None, False) if axis == 0 else (None, -share * greatest[1], False)
    found = velocity_at(texts, x, y, greatest)
    return None if found is None else (*found, True)
