"""The state that a launch host sends arrives complete."""

from __future__ import annotations

import json

from bot_console.tui.console.model import LaunchEvent, LaunchInfo, ProcessInfo, ProcessState, Program, Severity
from bot_console.tui.session.launch_host.plain_data import info_from_data, info_to_data

PROCESS = ProcessInfo(
    "1", "node-1", ProcessState.CRASHED, 7, ("/node",), ("a.launch.py",), 2, -9, "killed", program=Program(("node",))
)
INFO = LaunchInfo(("a.launch.py",), (PROCESS,), (LaunchEvent(0, 5, "begun", Severity.WARN),), "line 3", delayed=2)


def test_state_arrives_unchanged() -> None:
    assert info_from_data(json.loads(json.dumps(info_to_data(INFO, 0))), LaunchInfo(), kept=10) == INFO
