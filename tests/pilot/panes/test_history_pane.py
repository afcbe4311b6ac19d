"""History: the outcome of each change, the way back, and the moment that log and plot show."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.console.model import ChangeSource, Severity
from bot_console.tui.panes.history import pane as history
from bot_console.tui.panes.history.pane import HistoryPane
from bot_console.tui.panes.history.rows import ChangeRows
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.plot.pane import PlotPane
from fakes.console import START
from piloting import Clock, Session, run
from samples import live

NAVIGATOR = "/robot_navigator"


def shown_changes(session: Session) -> list[tuple[str, object]]:
    return [(each.name, each.new) for each in session.pane(ChangeRows).rows]


def set_requests(session: Session) -> list[dict[str, dict[str, object]]]:
    return [each[1] for each in session.console.asked if each[0] == "set_all"]


def test_changes_are_listed_newest_first_with_source_and_reason() -> None:
    async def play(session: Session) -> None:
        await session.press("H")
        assert shown_changes(session) == [("max_speed", 10.0), ("max_speed", 1.0), ("turn_rate", 1.5)]
        text = session.text()
        assert "✗ max_speed" in text and "too fast" in text
        assert "profile outdoor" in text and "11-13" in text, "an earlier run is shown with its date"
        await session.press("down")
        assert "ros2 param set /robot_navigator max_speed 1.0" in session.text()
        session.console.take(NAVIGATOR, {"turn_rate": 2.0}, ChangeSource.OTHER)
        await session.settle()
        assert shown_changes(session)[0] == ("turn_rate", 2.0)
        assert session.pane(ChangeRows).current.new == 1.0, "the cursor stays on its change"

    run(live(), play, (100, 30))


def test_effect_of_a_change_on_the_speed_is_shown_even_if_the_pane_was_hidden() -> None:
    async def play(session: Session) -> None:
        clock = session.pane(HistoryPane).clock = Clock()

        async def drive(speed: float, seconds: int) -> None:
            for _ in range(2 * seconds):
                clock.now += 0.5
                drive = replace(session.console.current.drive, actual=(speed, 0.0))
                session.console.change(drive=drive)
                session.app.pull()

        await drive(0.5, 2)
        session.console.take(NAVIGATOR, {"max_speed": 2.0}, ChangeSource.EDIT)
        await session.settle()
        await drive(1.0, 5)
        await session.press("H")
        row = next(line for line in session.lines() if "max_speed" in line and "2.0" in line)
        assert "speed 0.5 → 1.0 m/s in 0.5 s" in row
        assert "after it speed 0.5 → 1.0 m/s" in session.text(), "in the details of the row at the cursor"

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_source_and_reason_fit_at_80_columns_beside_long_names() -> None:
    async def play(session: Session) -> None:
        long = {"recovery.emergency_stop_distance": "a value that is long", "speed": 1.0}
        session.console.take("/warehouse/robot_navigator_of_the_dock", long, ChangeSource.OTHER)
        await session.press("H")
        line = next(each for each in session.text().splitlines() if "recovery" in each)
        assert "no service" in line and "_dock" in line and "→" in line

    run(live(), play, (80, 24))


def test_values_set_together_are_one_row_that_enter_opens_and_undoes_together() -> None:
    async def play(session: Session) -> None:
        session.console.take(NAVIGATOR, {"max_speed": 3.0, "turn_rate": 2.0}, ChangeSource.PROFILE, by="outdoor")
        await session.press("H")
        assert "▸ profile outdoor  2 values, 2 less safe" in session.text()
        assert "▲" in session.lines()[2], "the timeline"
        await session.press("enter")
        assert "▾ profile outdoor" in session.text() and "1.0 → 2.0" in session.text()
        await session.press("down", "left")
        assert "▸ profile outdoor" in session.text() and "1.0 → 2.0" not in session.text()
        await session.press("b", "y")
        assert set_requests(session) == [{NAVIGATOR: {"max_speed": 1.0, "turn_rate": 1.0}}]

    run(live(), play, (100, 30))


def test_going_back_to_a_row_asks_and_sets_all_values_together() -> None:
    async def play(session: Session) -> None:
        session.console.parameters.set(NAVIGATOR, {"max_speed": 2.0})
        session.console.parameters.set(NAVIGATOR, {"turn_rate": 2.0})
        session.console.parameters.set("/simulator", {"lidar.beams": 90})
        await session.press("H", "down", "down", "u")
        text = session.text()
        assert "turn_rate  2.0 → 1.0" in text and "lidar.beams  90 → 360" in text
        assert "max_speed" not in text.partition("max_speed?")[2].partition("y yes")[0], "it has not changed since"
        await session.press("n")
        assert set_requests(session) == []
        await session.press("u", "y")
        assert set_requests(session) == [{NAVIGATOR: {"turn_rate": 1.0}, "/simulator": {"lidar.beams": 360}}]
        assert "2 values put back" in session.text()
        tree = session.console.current.parameters[NAVIGATOR]
        assert (tree.get("turn_rate").value, tree.get("max_speed").value) == (1.0, 2.0)

    run(live(), play, (100, 30))


def test_question_names_the_values_that_reduce_safety_before_all_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(history, "MAX_NAMED_VALUES", 1)

    async def play(session: Session) -> None:
        session.console.take(NAVIGATOR, {"max_speed": 3.0, "safety_distance": 1.5}, ChangeSource.PROFILE, by="outdoor")
        await session.press("H", "b")
        question = session.text().partition("Put 2 values back?")[2].partition("y yes")[0]
        assert "safety_distance  1.5 → 0.8: lowers" in question and "max_speed" not in question
        assert "and 1 value more" in question

    run(live(), play, (120, 40))


def test_refused_revert_changes_nothing_and_shows_the_reason() -> None:
    async def play(session: Session) -> None:
        session.console.parameters.set(NAVIGATOR, {"turn_rate": 2.0})
        session.console.parameters.set("/simulator", {"lidar.beams": 90})
        session.console.refusals[NAVIGATOR, "turn_rate"] = "not while driving"
        await session.press("H", "down", "down", "u", "y")
        assert "Nothing was set" in session.text() and "not while driving" in session.text()
        assert session.console.current.parameters["/simulator"].get("lidar.beams").value == 90

    run(live(), play, (100, 30))


def test_single_change_is_reverted_with_a_safety_warning() -> None:
    async def play(session: Session) -> None:
        session.console.parameters.set(NAVIGATOR, {"safety_distance": 1.5})
        session.console.parameters.set(NAVIGATOR, {"turn_rate": 2.0})
        await session.press("H", "down", "b")
        assert "⚠" in session.text() and "lowers a safety margin" in session.text()
        await session.press("y")
        assert set_requests(session) == [{NAVIGATOR: {"safety_distance": 0.8}}]
        await session.press("G", "up", "up", "b")
        assert "was not set, so there is nothing" in session.text(), "a refusal"

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_changes_are_filtered_by_words_and_by_refusal() -> None:
    async def play(session: Session) -> None:
        await session.press("H", "slash")
        await session.paste("outdoor")
        await session.press("enter")
        assert shown_changes(session) == [("turn_rate", 1.5)] and "1 of 3" in session.text()
        await session.press("escape", "escape", "x")
        assert shown_changes(session) == [("max_speed", 10.0)]
        await session.press("escape")
        assert len(shown_changes(session)) == 3

    run(live(), play)


def test_value_whose_node_did_not_answer_differs_from_refused_one() -> None:
    async def play(session: Session) -> None:
        session.console.journal[-1] = replace(session.console.journal[-1], answered=False, reason="no answer in 5 s")
        await session.press("H")
        assert "? max_speed" in session.text() and "? 10.0 was not set: no answer in 5 s" in session.text()
        await session.press("slash")
        await session.paste("refused")
        await session.press("enter")
        assert shown_changes(session) == []

    run(live(), play)


@pytest.mark.slow
def test_log_and_plot_show_the_time_of_the_row() -> None:
    async def play(session: Session) -> None:
        for second in range(-20, 20):
            session.console.show_text(Severity.INFO, "clock", f"second {second}", START + second * 10**9)
        session.console.logs.clear()
        for second in range(-20, 20):
            session.console.show_text(Severity.INFO, "clock", f"second {second}", START + second * 10**9)
        await session.press("2", "4", "H", "down")
        at = session.app.time_cursor.stamp
        assert at == START - 12 * 10**9
        await session.press("2")
        logs = session.pane(LogsPane)
        assert session.console.logs.record(logs._list.number(logs._list.cursor)).text == "second -12"
        await session.press("4")
        assert "◆" in session.text() and "max_speed 0.7 → 1.0" in session.text()
        await session.press("full_stop")
        assert "✗ max_speed 10.0: too fast" in session.text()
        assert session.app.time_cursor.stamp == START - 5 * 10**9
        await session.press("H")
        assert session.pane(ChangeRows).current.accepted is False, "the row of the mark"
        await session.press("escape", "4")
        assert "◆" not in session.text() and session.pane(PlotPane)._timeline.paused_at is None

    run(live(), play, (120, 40))


def test_shown_changes_are_exported(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("H", "x", "e", "ctrl+u")
        await session.paste(f"{tmp_path}/refused.csv")
        await session.press("enter")
        lines = (tmp_path / "refused.csv").read_text().splitlines()
        assert len(lines) == 2 and "too fast" in lines[1]

    run(live(), play)
