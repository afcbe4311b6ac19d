"""Earlier lines: kept from run to run, and recalled by their beginning or by a part."""

from __future__ import annotations

from pathlib import Path

from bot_console.tui.commanding.history import MAX_LINES, LineHistory


def history_with(path: Path, *lines: str) -> LineHistory:
    history = LineHistory(path)
    for each in lines:
        history.add(each)
    return history


def test_history_is_stored_without_duplicates_newest_last(tmp_path: Path) -> None:
    history_with(tmp_path / "lines", "topic list", "set /a b 1", "topic list")
    assert LineHistory(tmp_path / "lines").lines() == ["set /a b 1", "topic list"]


def test_up_recalls_lines_with_the_typed_prefix_and_down_returns(tmp_path: Path) -> None:
    history = history_with(tmp_path / "lines", "topic list", "node list", "topic hz /odom")
    typed, seen = "topic", []
    for step in (-1, -1, -1, 1, 1, 1):
        typed = history.step(typed, step)
        seen.append(typed)
    assert seen == ["topic hz /odom", "topic list", "topic list", "topic hz /odom", "topic", "topic"]
    history.restart_walk()
    assert history.step("no", -1) == "node list"
    history.restart_walk()
    assert history.step("list", -1, anywhere=True) == "node list"
    assert history.step("node list", -1, anywhere=True) == "topic list"
    history.restart_walk()
    assert history.step("topic hz /odom", -1) == "topic hz /odom", "no other line begins like this"
    history.add("topic hz")
    assert history.step("topic hz", -1) == "topic hz /odom", "a line equal to the typed text is skipped"


def test_unwritable_history_lasts_until_exit(tmp_path: Path) -> None:
    (tmp_path / "lines").mkdir()
    assert history_with(tmp_path / "lines", "a", "b").lines() == ["a", "b"]


def test_history_length_is_limited(tmp_path: Path) -> None:
    (tmp_path / "lines").write_text("".join(f"line {number}\n" for number in range(2 * MAX_LINES)))
    history = history_with(tmp_path / "lines", "new")
    assert len(history.lines()) == MAX_LINES and history.lines()[-1] == "new"
