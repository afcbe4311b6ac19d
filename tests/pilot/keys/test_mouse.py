"""By mouse alone: tabs, rows, the key bar, questions and overlays; the wheel, and no keys."""

from __future__ import annotations

import pytest
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.topics.table import TopicRows
from bot_console.tui.screens.arrange_mode import ArrangeScreen
from bot_console.tui.screens.confirm import ConfirmScreen
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.widgets.row_list import RowList
from piloting import Session, run
from samples import live
from textual.events import Click, MouseDown
from textual.widgets._toast import Toast

NAVIGATOR = "/robot_navigator"


@pytest.mark.parametrize("keys", ["28", pytest.param("1345679HMBI", marks=pytest.mark.slow)])
def test_click_on_tab_opens_pane_and_click_selects_row(keys: str) -> None:
    async def play(session: Session) -> None:
        entries = [each for each in PANES if each.key in keys]
        assert len(entries) == len(keys)
        for entry in entries:
            await session.click_tab(entry.key)
            [pane] = session.app.visible_panes()
            assert pane.id == entry.id
            lists = [each for each in pane.query(RowList) if each.display and each.row_count() > 1]
            for shown in lists[:1]:
                await session.pilot.click(shown, offset=(12, 1))
                await session.settle()
                assert shown.cursor == shown.scroll_offset.y + 1 and shown.has_focus, entry.id

    run(live(), play, (200, 40))


def test_double_click_opens_row_and_click_outside_closes_box() -> None:
    async def play(session: Session) -> None:
        await session.click_tab("2")
        await session.pilot.click(session.pane(LogsPane).query(RowList).first(), offset=(40, 1), times=2)
        await session.settle()
        assert len(session.app.screen_stack) == 2
        await session.pilot.click(offset=(1, 1))
        await session.settle()
        assert len(session.app.screen_stack) == 1
        await session.click_tab("9")
        await session.pilot.click(TopicRows, offset=(10, 5), times=2)
        await session.settle()
        assert session.console.topics.listening, "the message of the topic is open"

    run(live(), play, (200, 40))


@pytest.mark.parametrize(("answer", "set_"), [("y yes", True), pytest.param("n no", False, marks=pytest.mark.slow)])
def test_a_question_is_answered_by_mouse(answer: str, set_: bool) -> None:
    async def play(session: Session) -> None:
        await session.click_tab("7")
        await session.click("competition")
        await session.click("a Apply")
        assert isinstance(session.app.screen, ConfirmScreen)
        await session.click(answer, last=True)
        assert len(session.app.screen_stack) == 1
        assert any(each[0] == "apply" for each in session.console.asked) is set_

    run(live(), play, (200, 40))


def test_clicks_already_queued_when_a_box_closes_do_nothing() -> None:
    async def play(session: Session) -> None:
        await session.press("V", "question_mark")
        box = session.app.screen
        for _ in range(3):
            box.post_message(Click(box, 0, 0, 0, 0, 1, False, False, False, 0, 0))
        await session.settle()
        await session.settle()
        assert isinstance(session.app.screen, ArrangeScreen) and session.app._exception is None

    run(live(), play)


@pytest.mark.parametrize(
    "keys", [pytest.param((), id="panes"), pytest.param(("question_mark",), id="box", marks=pytest.mark.slow)]
)
def test_mouse_press_where_a_notification_was_just_removed_does_not_end_the_console(keys: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        await session.press(*keys)
        session.app.notify("gone soon")
        await session.settle()
        screen = session.app.screen
        toast = screen.query_one(Toast)
        at = toast.region.offset
        toast.remove()  # it is part of the composed screen until the next frame
        session.app.post_message(MouseDown(None, at.x, at.y, 0, 0, 1, False, False, False, at.x, at.y))
        await session.settle()
        assert session.app._exception is None and session.app.is_running

    run(live(), play)


def test_click_chooses_option_and_key_bar_stops_the_robot() -> None:
    async def play(session: Session) -> None:
        await session.click_tab("8")
        await session.click("o Open", last=True)
        assert isinstance(session.app.screen, PickerScreen)
        options = session.app.screen.query_one(RowList)
        await session.pilot.click(options, offset=(6, 1))
        await session.settle()
        assert options.cursor == 1
        await session.pilot.click(options, offset=(6, 1), times=2)
        await session.settle()
        assert not isinstance(session.app.screen, PickerScreen)
        await session.press("escape")
        await session.click("! Stop", last=True)
        assert ("all_stop", True) in session.console.asked

    run(live(), play, (200, 40))


def test_click_on_help_line_presses_its_key() -> None:
    async def play(session: Session) -> None:
        await session.click_tab("1")
        await session.click("? Help")
        await session.click("Only what differs")
        assert len(session.app.screen_stack) == 1 and "seed" not in session.text()
        await session.click("? Help")
        await session.pilot.click(offset=(1, 1))
        await session.settle()
        assert len(session.app.screen_stack) == 1

    run(live(), play, (120, 60))
