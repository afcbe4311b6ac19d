"""Logs: followed, filtered, searched, saved; nothing is lost while a person reads."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.console.model import Endpoint, NodeInfo, Severity
from bot_console.tui.panes.history.pane import HistoryPane
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.logs.rows import LogRows
from bot_console.tui.panes.logs.rules import RuleBook
from bot_console.tui.panes.plot.pane import PlotPane
from fakes.console import START
from piloting import Session, run
from samples import live


def seqs(session: Session) -> list[int]:
    rows = session.pane(LogsPane).query_one(LogRows)
    return [rows.number(index) for index in range(rows.row_count())]


def test_newest_line_is_followed_until_the_user_scrolls_up() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        for number in range(60):
            session.console.show_text(Severity.INFO, "talker", f"line {number}")
        await session.settle()
        assert "line 59" in session.text()
        await session.press("up", "up")
        assert "paused, f follows" in session.text()
        session.console.show_text(Severity.INFO, "talker", "line 60")
        session.console.show_text(Severity.INFO, "talker", "line 61")
        await session.settle()
        assert "line 60" not in session.text() and "paused, 2 new below, f follows" in session.text()
        await session.press("f")
        assert "line 61" in session.text() and "new below" not in session.text()
        await session.press("up")
        assert "paused, f follows" in session.text(), "lines that were followed do not count as new"

    run(live(), play)


def test_lines_are_filtered_by_severity_words_and_node() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "w")
        assert len(seqs(session)) == 2
        await session.press("w", "v", "v", "v")
        assert len(seqs(session)) == 1
        await session.press("escape", "slash")
        await session.paste("node:navigator !max")
        await session.press("enter")
        assert len(seqs(session)) == 2
        await session.press("x", "enter")
        assert len(seqs(session)) == 0 and "1 rule hides" in session.pane(LogsPane).status_text()
        await session.press("t")
        assert len(seqs(session)) == 5 and "filters off, t restores them" in session.pane(LogsPane).status_text()
        await session.press("t", "escape")
        assert len(seqs(session)) == 2, "a rule stays"

    run(live(), play)


def test_next_error_is_shown_in_full_copied_and_saved(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("2", "g", "E", "enter")
        assert "node.py:7 in callback" in session.text()
        await session.press("escape", "y", "S")
        session.app.focused.value = str(tmp_path / "log.txt")
        await session.press("enter")

    run(live(), play)
    text = (tmp_path / "log.txt").read_text()
    assert text.count("\n") == 5 and "[ERROR]" in text


@pytest.mark.slow
def test_existing_file_is_replaced_only_after_a_question(tmp_path: Path) -> None:
    path = tmp_path / "mine [b].txt"

    async def play(session: Session) -> None:
        await session.press("2", "S")
        session.app.focused.value = " "
        await session.press("enter")
        assert "give a file name" in session.text()
        await session.press("escape")
        for answer, words in (("n", "mine"), ("y", "[ERROR]")):
            path.write_text("mine")
            await session.press("2", "S")
            session.app.focused.value = str(path)
            await session.press("enter")
            assert "Replace" in session.text() and path.read_text() == "mine"
            await session.press(answer)
            assert words in path.read_text()

    run(live(), play)


def test_a_rule_highlights_lines_and_is_kept() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "g", "plus", "enter")
        assert "▌" in session.text() and "In violet: node:=" in session.text()
        every = len(seqs(session))
        await session.press("o")
        assert 0 < len(seqs(session)) < every

    run(live(), play)
    rules = RuleBook()
    rules.read()
    assert len(rules.rules) == 1


@pytest.mark.slow
def test_rules_hide_and_highlight_lines() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "g", "plus", "enter")
        assert "▌" in session.text() and "In violet: node:=" in session.text()
        every = len(seqs(session))
        await session.press("o")
        shown = seqs(session)
        assert 0 < len(shown) < every and "highlighted only" in session.pane(LogsPane).status_text()
        await session.press("o", "F", "c", "c", "c", "c", "c", "c")
        assert "● hide" in session.text(), "after the last colour the rule hides lines"
        await session.press("space", "escape")
        assert len(seqs(session)) == every, "it is off"
        await session.press("F", "enter")
        session.app.focused.value = "sev:["
        await session.settle()
        assert "severity '[' is unknown" in session.text()
        session.app.focused.value = "sev:info"
        await session.press("enter", "space", "escape")
        assert 0 < len(seqs(session)) < every

    run(live(), play)
    rules = RuleBook()
    rules.read()
    assert [each.text for each in rules.rules] == ["hide sev:info"], "they are there at the next start"


@pytest.mark.slow
def test_a_search_hides_nothing_and_wraps_around() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(LogsPane)
        for number in range(3):
            session.console.show_text(Severity.INFO, "talker", f"zebra {number}")
            session.console.show_text(Severity.INFO, "talker", "horse")
        await session.press("2", "s")
        await session.paste("zebra")
        await session.press("enter")
        rows = pane.query_one(LogRows)

        def stands_on() -> str:
            record = rows.record
            return record.text if record else ""

        assert stands_on() == "zebra 2" and "match 3 of 3 zebra" in session.text()
        assert len(seqs(session)) == len(range(session.console.records.state.end))
        places = []
        for key in ("n", "n", "N", "N", "N"):
            await session.press(key)
            places.append(stands_on())
        assert places == ["zebra 0", "zebra 1", "zebra 0", "zebra 2", "zebra 1"]
        await session.press("slash")
        await session.paste("!zebra")
        await session.press("enter", "s")
        await session.paste("zebra")
        await session.press("enter")
        assert "Nothing here matches zebra" in session.text()

    run(live(), play)


def test_repeated_lines_are_folded_with_a_count() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        before = len(seqs(session))
        for _ in range(134):
            session.console.show_text(Severity.WARN, "talker", "again")
        await session.settle()
        assert "x134 again" in session.text() and len(seqs(session)) == before + 1
        session.console.show_text(Severity.WARN, "talker", "again")
        await session.settle()
        assert "x135 again" in session.text() and len(seqs(session)) == before + 1
        await session.press("r")
        assert len(seqs(session)) == before + 135 and "repeats shown" in session.text()
        await session.press("r")
        assert len(seqs(session)) == before + 1

    run(live(), play)


def test_saved_log_replaces_the_live_one(tmp_path: Path) -> None:
    path = tmp_path / "run.txt"
    path.write_text("[WARN] [1700000000.5] [/arm]: saved\nin two lines\n")

    async def play(session: Session) -> None:
        pane = session.pane(LogsPane)
        await session.press("2", "O")
        session.app.focused.value = str(tmp_path / "none.txt")
        await session.press("enter")
        assert "no such file" in session.text()
        session.app.clear_notifications()
        await session.press("O")
        session.app.focused.value = str(path)
        await session.press("enter")
        while not seqs(session):
            pane.tick()
            await session.pilot.pause()
        assert "saved⏎ in two lines" in session.text() and "O goes back" in session.text()
        await session.press("O")
        assert "saved" not in session.text() and len(seqs(session)) == 5

    run(live(), play)


@pytest.mark.slow
def test_line_leads_to_preceding_events_and_to_the_plot() -> None:
    async def play(session: Session) -> None:
        cursor = session.app.time_cursor
        await session.press("2", "g", "b")
        assert "max_speed: 1.0 → 10.0, refused: too fast" in session.text()
        await session.type("0.7")
        await session.press("enter")
        assert session.pane(HistoryPane).display and cursor.stamp == START - 12 * 10**9
        await session.press("2", "g", "p")
        assert session.pane(PlotPane).display and cursor.stamp == START
        await session.press("2", "escape")
        assert cursor.stamp is None

    run(live(), play)


def test_logger_levels_are_set_on_nodes_with_logger_services() -> None:
    async def play(session: Session) -> None:
        graph = session.console.current.graph
        offered = Endpoint("/robot_navigator/set_logger_levels", ("rcl_interfaces/srv/SetLoggerLevels",))
        session.console.change(graph=replace(graph, services=(*graph.services, offered)))
        await session.press("2", "l")
        assert "robot_navigator   D  I  W  E  F   as its parent" in session.text()
        assert "offer no logger service" in session.text()
        await session.press("w")
        assert "robot_navigator   D  I [W] E  F   WARN and worse" in session.text()
        assert session.console.levels == {"robot_navigator": Severity.WARN}
        await session.press("u")
        assert session.console.levels == {"robot_navigator": Severity.UNSET}

    run(live(), play)


@pytest.mark.slow
def test_name_of_a_node_that_has_left_is_still_spelled_as_in_the_graph() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        graph = session.console.current.graph
        session.console.change(graph=replace(graph, nodes=(*graph.nodes, NodeInfo("/arm/left/zoo"))))
        await session.settle()
        session.console.change(graph=graph)
        await session.settle()
        session.console.show_text(Severity.INFO, "arm.left.zoo", "gone")
        await session.press("2")
        assert any("/arm/left/zoo" in each and "gone" in each for each in session.lines())

    run(live(), play, (120, 30))
