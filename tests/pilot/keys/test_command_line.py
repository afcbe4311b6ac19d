"""The command line: its own verbs, `ros2` commands with `ros2` left out, completion, history, and helpful errors."""

from __future__ import annotations

import pytest
from bot_console.tui.keys.keyboard import MAX_PASTE_CHARACTERS
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.screens.output import OutputScreen
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.widgets.command_line import CommandField
from piloting import Session, run
from samples import SPEED, live
from textual.events import Paste
from textual.widgets import Input


async def line(session: Session, text: str) -> None:
    await session.press("colon")
    await session.paste(text)
    await session.press("enter")


def field(session: Session) -> str:
    return session.pane(CommandField).query_one(Input).value


def test_set_command_sets_value_or_shows_refusal() -> None:
    async def play(session: Session) -> None:
        await line(session, "set robot_navigator max_speed 1.4")
        assert ("set", "/robot_navigator", {"max_speed": 1.4}) in session.console.asked
        assert "/robot_navigator max_speed = 1.4" in [each.message for each in session.app._notifications]
        await line(session, "set /robot_navigator max_speed 99")
        assert "was refused" in session.text()

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_error_message_is_shown_in_full_at_80_columns() -> None:
    async def play(session: Session) -> None:
        await line(session, "lint running")
        reported_text = " ".join(" ".join(each[16:] for each in session.lines()[-5:]).split())
        assert "there is no command lint; help lists the commands, ^p finds an action by name" in reported_text
        assert field(session) == "lint running" and ":lint running" in session.text()

    run(live(), play, (80, 24))


def test_invalid_line_is_reported_and_stays_editable() -> None:
    async def play(session: Session) -> None:
        await session.press("colon")
        await session.type("topc list")
        await session.press("enter")
        assert "did you mean topic?" in session.text() and field(session) == "topc list"
        await session.press("escape")
        assert not session.pane(CommandField).is_open

    run(live(), play, (120, 40))


def test_paste_is_inserted_or_refused_as_a_whole() -> None:
    reported: list[str] = []

    async def play(session: Session) -> None:
        # A notification itself may expire while so much text is processed.
        session.app.notify = lambda message, **how: reported.append(message)
        await session.press("colon")
        for characters in (MAX_PASTE_CHARACTERS, MAX_PASTE_CHARACTERS + 1):
            session.app.post_message(Paste("x" * characters))
        await session.press("space", "y")
        assert field(session) == "x" * MAX_PASTE_CHARACTERS + " y"
        assert any("20,001 characters were pasted and ignored: the maximum is 20,000" in each for each in reported)
        await session.press("escape", "exclamation_mark")
        assert session.console.asked[-1] == ("all_stop", True)

    run(live(), play, (120, 40))


def test_commands_and_ros2_lines_are_run() -> None:
    async def play(session: Session) -> None:
        await line(session, "stop")
        assert session.console.asked[-1] == ("all_stop", True)
        await line(session, "release")
        assert session.console.asked[-1] == ("all_stop", False)
        await line(session, "node list")
        assert session.console.asked[-1] == ("run", "node list") and isinstance(session.app.screen, OutputScreen)
        assert "give up" not in session.lines()[-1]

    run(live(), play, (120, 40))


def test_commands_that_change_or_open_something_are_run() -> None:
    async def play(session: Session) -> None:
        await line(session, "layout tuning")
        assert session.app.stage.arranging.arrangement.name == "tuning"
        await line(session, f"plot {SPEED}")
        assert session.pane(PlotPane).display and session.pane(PlotPane).paths == [SPEED]
        await line(session, "help")
        assert "set NODE PARAMETER VALUE" in session.text() and "rqt_plot" in session.text()
        await session.press("escape", "ctrl+p")
        assert isinstance(session.app.screen, PickerScreen), "the palette has its own key"

    run(live(), play, (120, 40))


def test_tab_completes_and_focus_returns_to_the_pane() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        focused = session.app.focused
        await session.press("colon")
        await session.type("se")
        await session.press("tab")
        assert field(session) == "set "
        await session.type("navigator")
        await session.press("tab")
        assert field(session) == "set /robot_navigator "
        await session.type("max_sp")
        await session.press("tab")
        assert field(session) == "set /robot_navigator max_speed "
        assert "set NODE PARAMETER VALUE" in session.text()
        session.app.focused.value = "topic echo "  # type: ignore[union-attr]
        await session.press("tab")
        await session.press("tab")
        first = field(session)
        await session.press("tab", "shift+tab")
        assert field(session) == first and first.startswith("topic echo /")
        await session.press("escape")
        assert session.app.focused is focused

    run(live(), play)


def test_history_recalls_earlier_lines() -> None:
    async def play(session: Session) -> None:
        for each in ("node list", "topic list"):
            await line(session, each)
            await session.press("escape", "escape")
        await session.press("colon")
        await session.type("no")
        await session.press("up")
        assert field(session) == "node list"
        await session.press("down")
        assert field(session) == "no"
        session.app.focused.value = "list"  # type: ignore[union-attr]
        await session.press("ctrl+r")
        assert field(session) == "topic list"
        await session.press("enter")
        assert session.console.asked[-1] == ("run", "topic list")

    run(live(), play)
