"""How long a `ros2` line typed in the console may run."""

from __future__ import annotations

import pytest
from bot_console.tui.console.command_line_limits import goes_on


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
