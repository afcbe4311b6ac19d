"""The output below the processes: the newest lines; a new line moves few of them."""

from __future__ import annotations

from unittest.mock import patch

from bot_console.tui.console.model import LogRecord, Severity
from bot_console.tui.panes.launch.follow import OutputLine
from bot_console.tui.panes.launch.output import ProcessOutput
from textual.geometry import Size

ROOM = 9


def texts(output: ProcessOutput, count: int, name: str = "zoo-1") -> list[str]:
    """The drawn lines, once there are `count` of them."""
    lines = [OutputLine(LogRecord(at, 0, Severity.INFO, "zoo", f"line {at}")) for at in range(count)]
    with patch.object(ProcessOutput, "size", Size(60, 1 + ROOM)), patch.object(ProcessOutput, "refresh"):
        output.show_lines(name, lines, named=False)
    return [" ".join(text for text, _ in line) for line in output.lines]


def numbers(shown: list[str]) -> list[int]:
    return [int(each.rpartition("line ")[2]) for each in shown[1:] if "line " in each]


def test_newest_lines_are_shown_below_the_name() -> None:
    shown = texts(ProcessOutput(), 20)
    assert "output of zoo-1" in shown[0] and numbers(shown) == [*range(11, 20)]
    assert "nothing yet" in texts(ProcessOutput(), 0)[0]


def test_a_new_line_moves_the_others_only_when_there_is_no_free_row() -> None:
    output = ProcessOutput()
    texts(output, 20)
    moved = 0
    for count in range(21, 61):
        before = output.lines
        shown = texts(output, count)
        assert numbers(shown)[-1] == count - 1 and len(shown) == 1 + ROOM, "the newest is always there"
        assert len(numbers(shown)) >= ROOM * 2 // 3
        moved += output.lines[1] != before[1]
    assert moved == 10, "every fourth of forty"


def test_another_process_is_shown_with_all_the_lines_that_have_room() -> None:
    output = ProcessOutput()
    texts(output, 20)
    texts(output, 21)
    assert len(numbers(texts(output, 21, "ear-2"))) == ROOM


def test_another_log_is_shown_from_its_first_line() -> None:
    output = ProcessOutput()
    texts(output, 40)
    assert numbers(texts(output, 5)) == [*range(5)]
