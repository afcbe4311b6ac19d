"""The most recent output of a line that keeps running."""

from __future__ import annotations

import pytest
from bot_console.tui.console.running_lines import MAX_LINES, RunningLine, goes_on


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


@pytest.mark.parametrize(
    ("line", "lasts"),
    [
        ("action send_goal /navigate_to_pose nav2_msgs/action/NavigateToPose {}", True),
        ("action send_goal -h", False),
        ("action info /navigate_to_pose", False),
        ("service echo /reset", True),
        ("service call /reset std_srvs/srv/Trigger", False),
        ("topic hz /odom", True),
        ("topic echo --once /odom", False),
        ("topic echo", False),
    ],
)
def test_goals_and_measurements_may_take_any_time(line: str, lasts: bool) -> None:
    assert goes_on(line.split()) is lasts
