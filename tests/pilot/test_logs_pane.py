"""Logs: followed, filtered, searched, saved; nothing is lost while a person reads."""

from __future__ import annotations

from pathlib import Path

from bot_console.tui.console.model import Severity
from bot_console.tui.panes.logs.pane import LogRows, LogsPane
from piloting import Session, run
from samples import empty, live


def seqs(session: Session) -> list[int]:
    rows = session.pane(LogsPane).query_one(LogRows)
    return [rows.number(index) for index in range(rows.row_count())]


def test_the_newest_line_is_followed_until_somebody_scrolls_up() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        for number in range(60):
            session.console.say(Severity.INFO, "talker", f"line {number}")
        await session.settle()
        assert "line 59" in session.text()
        await session.press("up", "up")
        assert "paused, f follows" in session.text()
        session.console.say(Severity.INFO, "talker", "line 60")
        await session.settle()
        assert "line 60" not in session.text()
        await session.press("f")
        assert "line 60" in session.text()

    run(live(), play)


def test_severity_words_and_nodes_filter() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "w")
        assert len(seqs(session)) == 2
        await session.press("w", "v", "v", "v")
        assert len(seqs(session)) == 1
        await session.press("escape", "slash")
        await session.type("node:navigator !max")
        await session.press("enter")
        assert len(seqs(session)) == 2
        await session.press("x")
        assert len(seqs(session)) == 0 and "hidden: /robot_navigator" in session.text()
        await session.press("escape")
        assert len(seqs(session)) == 5

    run(live(), play)


def test_the_next_error_the_whole_message_copy_and_save(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("2", "g", "E", "enter")
        assert "node.py:7 in callback" in session.text()
        await session.press("escape", "y", "S")
        session.app.focused.value = str(tmp_path / "log.txt")
        await session.press("enter")

    run(live(), play)
    text = (tmp_path / "log.txt").read_text()
    assert text.count("\n") == 5 and "[ERROR]" in text


def test_a_file_that_is_there_is_replaced_only_when_asked_to(tmp_path: Path) -> None:
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


def test_a_bad_pattern_is_explained_and_an_empty_log_is_calm() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "E", "enter", "x", "y", "K", "f", "slash")
        session.app.clear_notifications()
        session.app.focused.value = "re:["
        await session.settle()
        assert "regular expression" in session.text()

    run(empty(), play)
