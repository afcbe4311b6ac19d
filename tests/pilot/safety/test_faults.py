"""A fault in a pane ends only that pane; one elsewhere stops the robot and ends the console with one line."""

from __future__ import annotations

import asyncio
import io
import sys
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import pytest
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.files import crash
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.broken_pane import BrokenPane
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.panes.steering.pane import SteeringPane
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.widgets.pane_area import PaneArea
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.tabs import Tabs
from piloting import Session, run
from samples import live
from textual.widget import Widget


@pytest.fixture(autouse=True)
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    return tmp_path / "state"


def raise_fault(self: object, *_: object, **__: object) -> None:
    raise KeyError("a [red]thing[/] that is missing")


FAULTS = {
    "an action": (ParametersPane, "action_edit", ["enter"]),
    "a message of a widget": (ParametersPane, "on_row_list_moved", ["down"]),
    "a drawing": (ParameterRows, "row", ["down"]),
    "a widget's own action": (RowList, "action_cursor", ["down"]),
}


BESIDE_OTHERS = ("a drawing",)
"""The faults that are also tried in a wide terminal, where other panes are drawn in the same frame."""
BY_DEFAULT = ("an action",)
"""The faults that the default run tries in a small terminal; it tries the drawing in the wide one."""


@pytest.mark.parametrize(
    ("kind", "size"),
    [
        *(
            pytest.param(kind, (80, 24), id=kind, marks=() if kind in BY_DEFAULT else pytest.mark.slow)
            for kind in FAULTS
        ),
        *(
            pytest.param(kind, (120, 40), id=f"{kind}, wide", marks=() if kind in BESIDE_OTHERS else pytest.mark.soak)
            for kind in FAULTS
        ),
    ],
)
def test_exception_ends_only_its_pane_and_enter_reopens_it(
    kind: str, size: tuple[int, int], monkeypatch: pytest.MonkeyPatch, state: Path
) -> None:
    owner, name, keys = FAULTS[kind]

    async def play(session: Session) -> None:
        await session.press("1")
        with monkeypatch.context() as broken:
            broken.setattr(owner, name, raise_fault)
            await session.press(*keys)
            await session.settle()
            text = session.text()
            assert "This pane has ended: KeyError" in text and "[red]thing[/]" in text
            assert [type(each) for each in session.app.visible_panes()] == [BrokenPane]
        await session.press("2", "question_mark", "escape", "1")
        assert not [each for each in session.console.asked if each[0] == "all_stop"]
        await session.press("enter")
        await session.settle()
        assert "max_speed" in session.text() and "has ended" not in session.text()
        await session.press("down", "e", "escape", "0")
        assert "KeyError" in next(state.iterdir()).read_text()

    run(live(), play, size, faults_wanted=True)


def test_exception_in_show_does_not_keep_other_panes_from_the_snapshot(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play(session: Session) -> None:
        monkeypatch.setattr(ParametersPane, "show", raise_fault)
        session.console.change(problem="everything is new")
        session.app.call_later(session.app.pull)
        await session.pilot.pause()
        await session.settle()
        assert sum(isinstance(each, BrokenPane) for each in session.app.visible_panes()) == 1
        assert "everything is new" in session.lines()[-2]

    run(live(), play, (120, 40), faults_wanted=True)


def test_failed_steering_pane_sends_zero_velocity(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "w", "w")
        assert session.console.sent[-1][0] > 0
        monkeypatch.setattr(SteeringPane, "action_steer", raise_fault)
        await session.press("w")
        await session.settle()
        assert session.console.sent[-1] == (0.0, 0.0)

    run(live(), play, faults_wanted=True)


def test_exception_in_an_overlay_closes_it(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play(session: Session) -> None:
        monkeypatch.setattr(HelpScreen, "action_scroll_box", raise_fault)
        await session.press("1", "question_mark", "j")
        await session.settle()
        assert len(session.app.screen_stack) == 1
        assert "KeyError" in session.text() and "max_speed" in session.text()

    run(live(), play, (120, 40), faults_wanted=True)


def test_exception_outside_panes_stops_robot_and_prints_one_line(monkeypatch: pytest.MonkeyPatch, state: Path) -> None:
    console, _ = live()
    message = io.StringIO()
    monkeypatch.setattr(sys, "__stderr__", message)

    async def main() -> int | None:
        app = BotConsoleApp(console, refresh_hz=0)
        monkeypatch.setattr(StatusBar, "show", raise_fault)
        try:
            async with app.run_test() as pilot:
                console.change(problem="new")
                app.pull()
                await pilot.pause()
        except KeyError:
            app._print_error_renderables()
        return app.return_code

    asyncio.run(main())
    assert ("all_stop", True) in console.asked
    assert len(message.getvalue().splitlines()) == 1 and "the robot was stopped: KeyError" in message.getvalue()
    assert "Traceback" in next(state.iterdir()).read_text()


def test_unwritable_folder_keeps_no_crash_report(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(crash, "state_folder", lambda: Path("/dev/null/x"))
    monkeypatch.setattr(crash.tempfile, "gettempdir", lambda: "/dev/null/y")
    assert crash.save_traceback(ValueError("x")) == "" and crash.reason(ValueError("a\nb")) == "ValueError: a b"


def test_plugin_panes_that_arrive_during_exit_are_ignored() -> None:
    async def play(session: Session) -> None:
        app = session.app
        area, tabs = app.screen_stack[0].query_one(PaneArea), app.screen_stack[0].query_one(Tabs)
        mount = area.mount

        async def mounted_at_the_end(*panes: Widget) -> None:
            await mount(*panes)
            await tabs.remove()
            app._running = False

        with patch.object(area, "mount", mounted_at_the_end):
            await app.controls.faults.add([replace(PANES[0], id="theirs")])
        app._running = True

    run(live(), play)
