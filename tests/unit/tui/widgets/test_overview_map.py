"""The small map of a picture that is larger than its window."""

from __future__ import annotations

import pytest
from bot_console.tui.widgets.diagram.drawing import Place
from bot_console.tui.widgets.diagram.overview_map import Window, map_lines, map_size, visible_part

PLACES = {
    "link": Place(0, 0, 10, 1, boxed=False),
    "box": Place(0, 0, 10, 3, boxed=True),
    "chosen": Place(90, 45, 10, 5, boxed=True),
}


@pytest.mark.parametrize(
    ("picture", "window", "size"),
    [
        ((80, 20), (80, 20), (0, 0)),
        ((200, 60), (120, 40), (30, 9)),
        ((200, 60), (60, 16), (15, 4)),
        ((200, 60), (30, 16), (0, 0)),
    ],
    ids=["all is visible", "as large as it may be", "a quarter of the window", "no room"],
)
def test_map_takes_a_quarter_of_the_window_where_a_part_is_hidden(
    picture: tuple[int, int], window: tuple[int, int], size: tuple[int, int]
) -> None:
    assert map_size(*picture, Window(0, 0, *window)) == size


@pytest.mark.parametrize("names", [("link", "box", "chosen"), ("chosen", "box", "link")])
def test_chosen_item_hides_a_box_and_a_box_hides_a_link(names: tuple[str, ...]) -> None:
    lines = map_lines({name: PLACES[name] for name in names}, (100, 50), (10, 5), "chosen")
    assert lines == ["▪         ", *[" " * 10] * 3, "         ●"]
    assert map_lines(PLACES, (10, 5), (1, 1), "chosen") == ["●"]


def test_visible_part_is_rounded_outwards_and_never_empty() -> None:
    assert visible_part((100, 50), (10, 5), Window(15, 5, 50, 20)) == (range(1, 7), range(0, 3))
    assert visible_part((1000, 500), (10, 5), Window(0, 0, 1, 1)) == (range(0, 1), range(0, 1))
