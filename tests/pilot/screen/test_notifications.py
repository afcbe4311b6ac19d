"""Notifications stand where they hide neither the keys, nor the state of the robot, nor what is known of a value."""

from __future__ import annotations

import pytest
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.tabs import Tabs
from piloting import Session, run
from samples import live
from textual.widgets._toast import Toast


def important(session: Session) -> list[str]:
    """The lines of tabs, detail, status and keys as they are on the screen."""
    regions = [session.app.screen.query_one(each).region for each in (KeyBar, StatusBar, "#parameter-detail", Tabs)]
    return [line for region in regions for line in session.lines()[region.y : region.bottom]]


@pytest.mark.parametrize("size", [(60, 20), (80, 24), (120, 40)])
def test_nothing_important_is_covered(size: tuple[int, int]) -> None:
    async def play(session: Session) -> None:
        await session.press("1", "exclamation_mark")
        before = important(session)
        for number in range(4):
            session.app.notify(f"{number}: " + "a long story " * 60, title="Much")
        await session.settle()
        assert len(session.app.screen.query(Toast)) == 4 and "a long story" in session.text()
        assert important(session) == before and "ALL STOP" in session.text()

    run(live(), play, size)


def test_errors_are_acknowledged() -> None:
    async def play(session: Session) -> None:
        assert "1 error" in session.text()
        await session.press("ctrl+e")
        assert "1 error" not in session.lines()[-2]

    run(live(), play, (120, 40))
