"""The console that `attach --ros` shows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.attach_options import AttachOptions
from bot_console.tui.console.model import Severity
from bot_console.tui.session.machine import ros


def test_first_line_of_the_log_names_the_search_range_of_ros_2(monkeypatch: pytest.MonkeyPatch) -> None:
    lines: list[tuple[Severity, str]] = []

    class Screen:
        """A session that is not shown."""

        def __init__(self, *_: Any, message: Sequence[tuple[Severity, str]], **__: Any) -> None:
            lines.extend(message)

        def run(self) -> int:
            return 0

    monkeypatch.setattr(ros, "AttachedSession", Screen)
    for name, value in (("ROS_DOMAIN_ID", "42"), ("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")):
        monkeypatch.setenv(name, value)
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_of_this_test")
    assert ros.run_ros(AttachOptions(Options()), "ROS 2 jazzy") == 0
    assert lines[0] == (Severity.INFO, "Searching domain 42, range LOCALHOST, this machine only (lo)")
    assert "ROS 2 jazzy" in lines[1][1] and "rmw_of_this_test" in lines[1][1]
