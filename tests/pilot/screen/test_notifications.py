"""Notifications are shown one at a time, where they hide neither keys, nor state, nor the row at the cursor."""

from __future__ import annotations

import pytest
from bot_console.tui.bag_app import PlayerBar
from bot_console.tui.console.model import Severity
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.tabs import Tabs
from bot_console.tui.widgets.toast_place import BELOW_ROWS, MAX_LINES, lines_below
from piloting import Session, run
from samples import live
from textual.widgets._toast import Toast

LONG = "a long story " * 60
SIZES = ((80, 24), (120, 40))


def lines_of(session: Session, *widgets: object) -> list[str]:
    regions = [session.app.screen.query_one(each).region for each in widgets]
    return [line for region in regions for line in session.lines()[region.y : region.bottom]]


def visible_toasts(session: Session) -> list[Toast]:
    return [each for each in session.app.screen.query(Toast) if each.region.height]


@pytest.mark.parametrize("size", [(60, 20), *(pytest.param(each, marks=pytest.mark.slow) for each in SIZES)])
def test_nothing_important_is_covered(size: tuple[int, int]) -> None:
    async def play(session: Session) -> None:
        await session.press("1", "exclamation_mark")
        important = (KeyBar, StatusBar, Tabs)
        before = lines_of(session, *important)
        for number in range(4):
            session.app.notify(f"{number}: " + LONG, title="Much")
        await session.settle()
        assert "a long story" in session.text()
        assert lines_of(session, *important) == before and "ALL STOP" in session.text()

    run(live(), play, size)


@pytest.mark.parametrize("size", [SIZES[0], pytest.param(SIZES[1], marks=pytest.mark.slow)])
@pytest.mark.parametrize("end", [pytest.param("home", marks=pytest.mark.slow), "end"])
def test_row_at_the_cursor_is_never_covered(size: tuple[int, int], end: str) -> None:
    async def play(session: Session) -> None:
        for number in range(size[1]):
            session.console.show_text(Severity.INFO, "talker", f"line {number}")
        await session.press("2", end)
        session.app.notify(LONG)
        await session.settle()
        rows, (toast,) = session.app.screen.focused, visible_toasts(session)
        assert isinstance(rows, RowList)
        line = rows.content_region.y + rows.cursor - rows.scroll_offset.y
        in_its_place = line >= size[1] - BELOW_ROWS - MAX_LINES
        assert in_its_place is (end == "end"), "otherwise the test would prove nothing"
        assert not toast.region.y <= line < toast.region.bottom
        assert toast.region.bottom <= size[1] - 2 and toast.region.height <= MAX_LINES

    run(live(), play, size)


def test_player_of_a_bag_is_never_covered() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await session.app.mount(PlayerBar(id="player"), before=session.app.screen.query_one(StatusBar))
        session.app.screen.query_one(PlayerBar).show_text("▶ 12.0 s of 30.0 s")
        session.app.notify(LONG)
        await session.settle()
        session.app._heartbeat()
        await session.settle()
        assert "▶ 12.0 s of 30.0 s" in session.text() and "a long story" in session.text()

    run(live(), play, (80, 24))


def test_a_text_field_is_never_covered() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "down", "slash", "s", "p")
        session.app.notify(LONG)
        await session.settle()
        (toast,) = visible_toasts(session)
        assert toast.region.bottom <= session.app.screen.focused.region.y

    run(live(), play, (80, 24))


def test_only_the_newest_notification_is_shown_with_the_number_of_others() -> None:
    async def play(session: Session) -> None:
        for word in ("first", "second", "third"):
            session.app.notify(f"the {word} one")
        await session.settle()
        assert len(visible_toasts(session)) == 1
        assert "the third one  +2 more" in session.text() and "the second one" not in session.text()
        await session.pilot.click(visible_toasts(session)[0])
        session.app._heartbeat()
        await session.settle()
        assert "the second one" in session.text() and "the third one" not in session.text()

    run(live(), play, (80, 24))


def test_notification_is_at_the_bottom_unless_that_covers_the_line_in_use() -> None:
    assert lines_below(None, 24) == lines_below(3, 24) == 2
    assert lines_below(20, 24) == 4 and lines_below(23, 24) == 2
    assert lines_below(None, 24, 4) == 4 and lines_below(20, 24, 4) == 4 and lines_below(19, 24, 4) == 5


def test_errors_are_acknowledged() -> None:
    async def play(session: Session) -> None:
        assert "1 error" in session.text()
        await session.press("ctrl+e")
        assert "1 error" not in session.lines()[-2]

    run(live(), play, (120, 40))
