"""A typed `ros2 param set` line is judged like every other change."""

from __future__ import annotations

import pytest
from bot_console.tui.safety.line_risk import risk_of
from samples import live


@pytest.mark.parametrize(
    ("line", "risk"),
    [
        ("ros2 param set /robot_navigator max_speed 4.0", "raises a safety limit"),
        ("ros2 param set robot_navigator enable_safety false", "turns a protection off"),
        ("ros2 param set /robot_navigator max_speed 0.5", ""),
        ("ros2 param set /robot_navigator max_speed fast", ""),
        ("ros2 param set /nobody max_speed 4.0", ""),
        ("ros2 param set /robot_navigator max_speed", ""),
        ("ros2 param get /robot_navigator max_speed", ""),
        ("ros2 topic echo '/odom", ""),
    ],
)
def test_unsafe_command_line_is_recognised(line: str, risk: str) -> None:
    assert risk_of(line, live()[0].snapshot()) == risk
