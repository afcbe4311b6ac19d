"""The status line: what is worth the little room, the reason first."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from bot_console.tui.console.model import ConsoleSnapshot, LaunchInfo, LogState, Severity
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.widgets.status_bar import reason_first, status_text


def test_the_reason_of_a_launch_that_failed_comes_before_the_file() -> None:
    problem = "/home/me/a/long/workspace/src/robot/launch/robot.launch.py, line 12: invalid syntax"
    assert reason_first(problem) == "invalid syntax (robot.launch.py, line 12)"
    assert reason_first("there is no package: robot") == "there is no package: robot"
    assert status_text(ConsoleSnapshot(launch=LaunchInfo(problem=problem))).startswith("invalid syntax (robot")


def test_only_errors_that_were_not_acknowledged_are_counted() -> None:
    counts = {Severity.ERROR: 2, Severity.FATAL: 1, Severity.INFO: 9}
    snapshot = ConsoleSnapshot(logs=LogState(counts=MappingProxyType(counts)))
    assert "3 errors" in status_text(snapshot)
    assert "1 new error" in status_text(snapshot, acknowledged=2) and "errors" not in status_text(snapshot, 0, 2)
    assert "error" not in status_text(snapshot, acknowledged=3)


def test_a_stop_where_no_robot_is_reports_that_nothing_is_there_to_stop() -> None:
    nobody = DriveInfo(stopped=True, stopped_here=True)
    assert "nothing is here to stop" in status_text(ConsoleSnapshot(drive=nobody))
    for robot in (DriveInfo(stopped=True, topic="/cmd_vel"), DriveInfo(stopped=True, lockable=True)):
        assert "STOP SENT, NOT CONFIRMED" in status_text(ConsoleSnapshot(drive=robot))


def test_a_console_that_is_read_only_promises_no_release() -> None:
    held = DriveInfo(stopped=True, stop_confirmed=True, lockable=True, stopped_here=True, refused="it only looks on")
    assert "released elsewhere" in status_text(ConsoleSnapshot(drive=held))
    assert "! releases" in status_text(ConsoleSnapshot(drive=replace(held, refused="")))


def test_a_robot_that_has_reported_nothing_yet_is_one() -> None:
    assert status_text(ConsoleSnapshot()) == "no robot yet"
    assert status_text(ConsoleSnapshot(drive=DriveInfo(topic="/a/cmd_vel"))) == "no command and no odometry yet"
