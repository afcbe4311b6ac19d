"""The canvas that turtles draw on."""

from __future__ import annotations

import math

import pytest
from bot_console_demos.turtlesim.canvas import BLANK, Canvas, Pen

RED = Pen((255, 0, 0), 3)


def test_line_has_the_width_of_the_pen() -> None:
    canvas = Canvas()
    canvas.line((1.0, 2.0), (3.0, 2.0), RED)
    for x in (1.0, 1.7, 2.5, 3.0):
        assert canvas.color((x, 2.0)) == RED.color
        assert canvas.color((x, 2.0 + 1 / 45)) == RED.color
        assert canvas.color((x, 2.0 + 3 / 45)) == BLANK
    assert canvas.color((0.9, 2.0)) == BLANK


def test_slanting_line_has_no_holes() -> None:
    canvas = Canvas()
    canvas.line((0.0, 0.0), (11.0, 7.0), Pen((1, 2, 3), 1))
    drawn = canvas.picture((0, 0, 0))[:, :, 3] == 255
    assert drawn.any(axis=0)[: 11 * 45].all()


@pytest.mark.parametrize("end", [(-5.0, 2.0), (40.0, 40.0), (math.inf, 1.0), (math.nan, 1.0)])
def test_drawing_outside_the_canvas_is_ignored(end: tuple[float, float]) -> None:
    canvas = Canvas()
    canvas.line((1.0, 1.0), end, RED)
    assert canvas.picture((0, 0, 0)).shape == (500, 500, 4)


def test_picture_fills_the_background_and_clear_erases() -> None:
    canvas = Canvas()
    canvas.line((1.0, 1.0), (1.0, 1.0), RED)
    before = canvas.changes
    picture = canvas.picture((7, 8, 9))
    assert picture[45, 45].tolist() == [255, 0, 0, 255]
    assert picture[400, 400].tolist() == [7, 8, 9, 0]
    canvas.clear()
    assert canvas.changes > before
    assert canvas.color((1.0, 1.0)) == BLANK
