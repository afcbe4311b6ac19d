"""The most recent output of a running command line."""

from __future__ import annotations

from bot_console.tui.console.running_line import MAX_LINES, RunningLine


def test_pieces_are_joined_into_lines_and_only_the_last_are_kept() -> None:
    line = RunningLine()
    assert line.lines() == ()
    line.append("a\nb")
    assert line.lines() == ("a",)
    same = line.lines()
    assert line.lines() is same
    line.append("c\n")
    assert line.lines() == ("a", "bc")
    line.append("d")
    line.end()
    assert line.lines() == ("a", "bc", "d") and line.ended
    line.append("".join(f"{number}\n" for number in range(1000)))
    assert len(line.lines()) == MAX_LINES and line.lines()[-1] == "999"
