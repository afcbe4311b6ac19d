"""Fields of turtles as text."""

from __future__ import annotations

import numpy as np
from bot_console.tui.console.robot.robot_model import Drawing, Pose, Turtle, TurtleField
from bot_console.tui.panes.world.turtle_field import SIDE_M, FieldDrawing
from bot_console.tui.widgets.picture import Line

WIDTH, HEIGHT = 40, 20


def drawing(*lines: tuple[int, int, int], background: tuple[int, int, int] = (69, 86, 255)) -> Drawing:
    """A drawing with a horizontal line of each colour, at equal distances from top to bottom."""
    pixels = np.zeros((500, 500, 4), np.uint8)
    pixels[:] = (*background, 0)
    for number, color in enumerate(lines, 1):
        at = number * 500 // (len(lines) + 1)
        pixels[at : at + 3, 100:400] = (*color, 255)
    return Drawing(500, 500, pixels.tobytes())


def text(rows: list[Line]) -> list[str]:
    return ["".join(piece for piece, _ in row) for row in rows]


def test_a_field_is_filled_with_its_background_and_is_a_square() -> None:
    rows = FieldDrawing().rows(TurtleField("/sim", (), drawing(background=(1, 2, 3))), 60, 20)
    assert rows == [((" " * 10, ""), (" " * 40, "on #010203"), (" " * 10, ""))] * 20


def test_lines_have_the_colours_of_their_pens() -> None:
    rows = FieldDrawing().rows(TurtleField("/sim", (), drawing((255, 0, 0), (0, 255, 0))), WIDTH, HEIGHT)
    styles = {style for row in rows for piece, style in row if piece.strip()}
    assert styles == {"#ff0000 on #4556ff", "#00ff00 on #4556ff"}
    red = next(row for row in text(rows) if row.strip())
    assert (len(red) - len(red.lstrip()), len(red.strip())) == (8, 24)


def test_a_turtle_is_drawn_as_an_arrow_at_its_position() -> None:
    turtle = Turtle("leo", Pose(SIDE_M - 0.01, 0.01, 1.57))
    rows = text(FieldDrawing().rows(TurtleField("/sim", (turtle,), drawing()), WIDTH, HEIGHT))
    assert rows[-1][-1] == "↑"
    assert "leo" not in "".join(rows)


def test_several_turtles_have_names_beside_them() -> None:
    turtles = Turtle("leo", Pose(1.0, 1.0, 0.0)), Turtle("raphael", Pose(10.7, 5.0, 3.14))
    rows = text(FieldDrawing().rows(TurtleField("/sim", turtles, drawing()), WIDTH, HEIGHT))
    assert any("→leo" in row for row in rows)
    assert any(row.rstrip().endswith("←r") for row in rows)


def test_without_a_drawing_trails_are_shown() -> None:
    trail = tuple((2.0 + 0.1 * step, 5.0) for step in range(60))
    rows = FieldDrawing().rows(TurtleField("/sim", (Turtle("leo", Pose(8.0, 5.0), trail=trail),)), WIDTH, HEIGHT)
    assert any(style == "#b3b8ff on #4556ff" for row in rows for _, style in row)


def test_a_turtle_outside_and_a_tiny_pane_are_drawn_without_an_error() -> None:
    turtle = Turtle("leo", Pose(-3.0, 99.0, float("nan")))
    for width, height in ((4, 2), (5, 9), (200, 3)):
        rows = FieldDrawing().rows(TurtleField("/sim", (turtle, turtle), drawing((9, 9, 9))), width, height)
        assert {len(row) for row in text(rows)} == {width}
        assert len(rows) == height
