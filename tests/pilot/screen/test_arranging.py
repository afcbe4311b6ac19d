"""Arranging the panes: by key, by mouse, and by the name of a layout."""

from __future__ import annotations

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.layout.tree import Tree, below, beside, panes
from bot_console.tui.pane_table import PANES
from bot_console.tui.screens.arrange_mode import ArrangeScreen, keys_line
from bot_console.tui.widgets.pane_area import PaneArea
from piloting import Session, run
from samples import live
from textual.geometry import Region

SIZE = (120, 40)


def tree(session: Session) -> Tree:
    return session.pane(PaneArea).shown


def visible_regions(session: Session) -> dict[str, Region]:
    return {pane.id or "": pane.region for pane in session.app.visible_panes()}


def test_pane_is_split_closed_and_restored() -> None:
    async def play(session: Session) -> None:
        before = tree(session)
        await session.press("V")
        assert isinstance(session.app.screen, ArrangeScreen)
        await session.press("v")
        await session.paste("steer")
        await session.press("enter")
        assert "steering" in visible_regions(session) and session.app.current_pane.id == "steering"
        parameters, steering = visible_regions(session)["parameters"], visible_regions(session)["steering"]
        assert steering.x == parameters.right and steering.y == parameters.y
        await session.press("x")
        assert panes(tree(session)) == panes(before)
        await session.press("u", "u")
        assert tree(session) == before
        await session.press("escape")
        assert len(session.app.screen_stack) == 1

    run(live(), play, SIZE)


@pytest.mark.parametrize("columns", [60, 80, 100, 120])
def test_keys_for_save_stop_help_and_done_are_never_cut(columns: int) -> None:
    line = keys_line(columns - 2).plain
    assert len(line) <= columns - 2
    assert all(each in line for each in ("w Save", "? Help", "! Stop", "esc Done"))


def test_key_bar_names_all_arranging_keys_if_there_is_room() -> None:
    line = keys_line(200).plain
    assert all(f" {key.footer}" in line for key in TABLE["arrange"] if key.footer)


@pytest.mark.slow
def test_help_explains_arranging_keys_and_fits_after_resizing() -> None:
    async def play(session: Session) -> None:
        await session.press("V")
        assert "esc Done" in session.lines()[-1] and "w Save" in session.lines()[-1]
        await session.press("question_mark")
        text = session.text()
        assert "Arranging the panes" in text and "Put another pane beside it" in text
        assert "Everywhere" not in text and "Command palette" not in text
        await session.press("escape")
        assert isinstance(session.app.screen, ArrangeScreen)
        await session.pilot.resize_terminal(60, 20)
        await session.settle()
        assert "esc Done" in session.lines()[-1]

    run(live(), play, (100, 30))


def test_arrow_keys_select_and_swap_panes() -> None:
    async def play(session: Session) -> None:
        await session.press("V", "right")
        assert session.app.current_pane.id == "world"
        await session.press("down")
        assert session.app.current_pane.id == "plot"
        where = visible_regions(session)["plot"]
        await session.press("K")
        await session.settle()
        assert visible_regions(session)["world"] == where and session.app.current_pane.id == "plot"
        wide = visible_regions(session)["plot"].width
        await session.press("right_square_bracket", "right_square_bracket")
        await session.settle()
        assert visible_regions(session)["plot"].width > wide, "nothing lies to the right: it grows to the left"
        await session.press("escape")

    run(live(), play, SIZE)


def test_growing_a_pane_shrinks_its_neighbour() -> None:
    async def play(session: Session) -> None:
        before = visible_regions(session)
        await session.press("V", "right_square_bracket", "plus")
        await session.settle()
        after = visible_regions(session)
        assert after["parameters"].width > before["parameters"].width
        assert after["logs"].height < before["logs"].height
        await session.press(*["right_square_bracket"] * 20)
        await session.settle()
        assert visible_regions(session)["world"].width >= 20, "no pane becomes too small to be used"

    run(live(), play, SIZE)


def test_layout_is_saved_under_a_name_and_reopened() -> None:
    async def play(session: Session) -> None:
        await session.press("V", "x", "w")
        await session.paste("mine")
        assert session.lines()[-2].startswith(" save as mine")
        assert session.lines()[-1].split() == ["Enter", "OK", "·", "Esc", "Cancel"]
        await session.press("enter")
        assert session.lines()[-1].startswith(" Arrange")
        kept = tree(session)
        assert session.app.stage.arranging.arrangement.title == "mine"
        await session.press("o")
        await session.paste("tuning")
        await session.press("enter")
        assert set(visible_regions(session)) == {"parameters", "plot", "world"}
        await session.press("o")
        await session.paste("mine")
        await session.press("enter")
        assert tree(session) == kept and "[0 mine]" in session.lines()[0]

    run(live(), play, SIZE)


def test_layout_without_room_shows_one_pane_and_a_message() -> None:
    async def play(session: Session) -> None:
        session.app.stage.arrangement.change(below(*(each.id for each in PANES[:6])))
        await session.press("V")
        assert len(session.app.screen_stack) == 1 and "needs 20x27" in session.text()

    run(live(), play, (70, 22))


def test_dragging_a_border_resizes_panes() -> None:
    async def play(session: Session) -> None:
        before = visible_regions(session)
        edge = before["parameters"].right - 1
        await session.pilot.mouse_down(offset=(edge, 5))
        await session.pilot.hover(offset=(edge + 12, 5))
        await session.pilot.hover(offset=(edge + 15, 5))
        await session.pilot.mouse_up(offset=(edge + 15, 5))
        await session.settle()
        assert visible_regions(session)["parameters"].width == before["parameters"].width + 15
        session.app.stage.arranging.undo()
        await session.settle()
        assert visible_regions(session) == before, "a drag is one step"

    run(live(), play, SIZE)


@pytest.mark.slow
def test_click_on_a_tab_selects_the_pane_while_arranging() -> None:
    async def play(session: Session) -> None:
        at = session.lines()[0].index("Graph")
        await session.pilot.click(offset=(at, 0))
        await session.settle()
        assert set(visible_regions(session)) == {"graph"}
        await session.pilot.click(offset=(3, 0))
        await session.settle()
        assert "logs" in visible_regions(session)

    run(live(), play, SIZE)


def test_stop_key_works_while_arranging() -> None:
    async def play(session: Session) -> None:
        await session.press("V", "exclamation_mark")
        assert session.console.asked[-1] == ("all_stop", True)

    run(live(), play, SIZE)


def test_tab_visits_visible_panes_from_the_upper_left() -> None:
    async def play(session: Session) -> None:
        session.app.stage.arranging.arrangement.change(beside("plot", "parameters"))
        session.app.stage.lay_out()
        await session.press("tab")
        first = session.app.current_pane.id
        await session.press("tab")
        assert {first, session.app.current_pane.id} == {"plot", "parameters"}

    run(live(), play, SIZE)
