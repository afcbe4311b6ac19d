"""Nothing overflows at any size at which the console works."""

from __future__ import annotations

from itertools import cycle

import pytest
from bot_console.tui.layout.tree import below
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.parameters.table import ParameterRows
from piloting import Session, run
from samples import empty, faulty, live
from textual.scroll_view import ScrollView
from textual.widgets._toast import Toast

SIZES = [(60, 20), (80, 24), (100, 30), (120, 40), (170, 45), (200, 50), (250, 80)]


def lines_of(session: Session, size: tuple[int, int]) -> list[str]:
    """The lines on the screen; checks that they fill it."""
    strips = session.app.screen._compositor.render_strips()
    assert len(strips) == size[1]
    assert {strip.cell_length for strip in strips} == {size[0]}
    return [strip.text for strip in strips]


def check(session: Session, size: tuple[int, int]) -> None:
    lines = lines_of(session, size)
    whole = session.app.screen.region
    for pane in session.app.visible_panes():
        assert whole.contains_region(pane.region), pane.id
        for child in pane.walk_children():
            if child.display and child.region.area and not isinstance(child.parent, ScrollView):
                assert pane.region.contains_region(child.region), (pane.id, child)
    assert lines[0].strip().startswith(("0", "[0")), "the tabs are visible"
    assert "! Stop" in lines[-1], "the keys are visible"


CASES = [(size, live) for size in SIZES] + [
    (size, other) for size in (SIZES[0], SIZES[-1]) for other in (empty, faulty)
]
MARKS = {
    (SIZES[0], faulty): [],
    ((120, 40), live): [pytest.mark.slow],
    (SIZES[0], empty): [pytest.mark.slow],
}
"""The marks of size and state: scarce room and a usual terminal before each change, the others in the soak run.

One pane is also resized through all sizes below.
"""


@pytest.mark.parametrize(
    ("size", "system"),
    [pytest.param(*each, marks=MARKS.get(each, [pytest.mark.soak])) for each in CASES],
    ids=[f"{w}x{h}-{system.__name__}" for (w, h), system in CASES],
)
def test_every_pane_and_the_overview_fit(size, system) -> None:
    async def play(session: Session) -> None:
        for digit in ("0", *(each.key for each in PANES)):
            await session.press(digit)
            check(session, size)

    run(system(), play, size)


@pytest.mark.slow
@pytest.mark.parametrize("digits", ["01", "23456789HMBI"])
def test_below_the_minimum_size_only_a_message_is_shown(digits: str) -> None:
    async def play(session: Session) -> None:
        for digit, size in zip(digits, cycle(((59, 20), (60, 19), (40, 10)))):
            await session.pilot.resize_terminal(80, 24)
            await session.press(digit)
            await session.pilot.resize_terminal(*size)
            await session.settle()
            text = "\n".join(lines_of(session, size))
            assert f"{size[0]}x{size[1]} is too small" in text
            assert all(word in text for word in ("60x20", "! stops it", "q quits"))

    run(live(), play)


@pytest.mark.slow
def test_resize_updates_the_layout() -> None:
    async def play(session: Session) -> None:
        for size in ((250, 80), (60, 20), (170, 45), (80, 24), (120, 40)):
            await session.pilot.resize_terminal(*size)
            await session.settle()
            check(session, size)

    run(live(), play)


@pytest.mark.parametrize(
    "size",
    [
        (60, 20),
        *(pytest.param(each, marks=pytest.mark.slow) for each in ((80, 24), (99, 40), (100, 30), (120, 40), (200, 50))),
    ],
)
def test_0_shows_the_robot_at_a_glance_at_any_size(size) -> None:
    async def play(session: Session) -> None:
        await session.press("2", "0")
        assert not session.app.screen.query(Toast)
        assert {"world", "parameters", "logs"} <= {each.id for each in session.app.visible_panes()}
        await session.press("1", "0")
        at = session.app.screen.query_one(ParameterRows).current
        assert at is not None and at.parameter is not None and at.parameter.name == "max_speed", "worth changing"

    run(live(), play, size)


def test_small_panes_show_what_matters_most() -> None:
    async def play(session: Session) -> None:
        names = [row.name for row in session.app.screen.query_one(ParameterRows).rows]
        assert names == ["max_speed", "turn_rate", "safety_distance"]
        await session.press("slash")
        await session.paste("noise")
        await session.press("enter")
        assert "noise" in session.text(), "a filter finds all"
        await session.press("escape", "1")
        assert "detection_threshold" in session.text() and "Maximum linear velocity" in session.text()

    run(live(), play, (80, 24))


@pytest.mark.slow
def test_layout_without_room_shows_one_pane_silently() -> None:
    async def play(session: Session) -> None:
        session.app.stage.arrangement.load("watching")
        session.app.stage.arrangement.change(below(*(each.id for each in PANES[:6])))
        await session.press("2", "0")
        assert not session.app.screen.query(Toast)
        assert [each.id for each in session.app.visible_panes()] == ["logs"]

    run(live(), play, (80, 24))
