"""The status line: what deserves the limited room, the reason first."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

import pytest
from bot_console.tui.console.bags.port import RecordingInfo
from bot_console.tui.console.model import ConsoleSnapshot, LaunchInfo, LinkInfo, LogState, RateCheck, Severity
from bot_console.tui.console.robot.robot_model import DriveInfo, RobotStop
from bot_console.tui.widgets.status_bar import drive_figures, reason_first, status_text


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


def test_a_stop_without_a_robot_reports_that_there_is_nothing_to_stop() -> None:
    nobody = DriveInfo(stopped=True, stopped_here=True)
    assert "STOP REACHES NOBODY: no robot listens for commands" in status_text(ConsoleSnapshot(drive=nobody))
    for robot in (DriveInfo(stopped=True, topic="/cmd_vel"), DriveInfo(stopped=True, lockable=True)):
        assert "STOP SENT, NOT CONFIRMED" in status_text(ConsoleSnapshot(drive=robot))


def test_stop_of_another_person_that_only_some_locks_hold_is_not_called_sent() -> None:
    stops = (RobotStop("a1", "anna@pc", "the arm swings"),)
    partly = DriveInfo(stopped=True, lockable=True, stops=stops, stop_holder="anna@pc", stop_reason="the arm swings")
    text = status_text(ConsoleSnapshot(drive=partly))
    assert text.startswith("STOP NOT CONFIRMED: THE ROBOT MAY MOVE (! stops it), stop by anna@pc: the arm swings")
    assert "STOP SENT" in status_text(ConsoleSnapshot(drive=replace(partly, stopped_here=True)))


def test_a_console_that_is_read_only_promises_no_release() -> None:
    held = DriveInfo(stopped=True, stop_confirmed=True, lockable=True, stopped_here=True, refused="it only looks on")
    assert "released elsewhere" in status_text(ConsoleSnapshot(drive=held))
    assert "! " not in status_text(ConsoleSnapshot(drive=replace(held, lockable=False, topic="/cmd_vel")))


def test_zeros_of_a_console_that_is_read_only_end_with_it() -> None:
    zeros = DriveInfo(stopped=True, stopped_here=True, refused="it only looks on", topic="/cmd_vel")
    text = status_text(ConsoleSnapshot(drive=zeros))
    assert text.startswith("STOP SENT, NOT CONFIRMED: THE ROBOT MAY MOVE, zeros only (q ends it: read-only console)")
    assert "released elsewhere" in status_text(ConsoleSnapshot(drive=replace(zeros, stop_confirmed=True)))


def test_stop_key_promises_no_release_while_a_question_lets_it_only_hold() -> None:
    held = DriveInfo(stopped=True, stop_confirmed=True, lockable=True, stopped_here=True, own_stops=frozenset(["ours"]))
    for drive in (held, replace(held, own_stops=frozenset(), stopped_here=False)):
        assert "(! keeps it held)" in status_text(ConsoleSnapshot(drive=replace(drive, key_only_holds=True)))


def test_stop_key_promises_nothing_while_it_is_text() -> None:
    held = DriveInfo(stopped=True, stop_confirmed=True, lockable=True, stopped_here=True, own_stops=frozenset(["ours"]))
    unconfirmed = replace(held, stop_confirmed=False)
    others = replace(held, own_stops=frozenset(), stopped_here=False)
    without_lock = replace(held, lockable=False, topic="/cmd_vel", stop_confirmed=False)
    for drive in (held, unconfirmed, others, without_lock, replace(held, key_only_holds=True)):
        text = status_text(ConsoleSnapshot(drive=replace(drive, key_is_text=True)))
        assert "(! is a letter here)" in text and text.count("!") == 1


def test_silent_robot_is_distinguished_from_no_robot() -> None:
    assert status_text(ConsoleSnapshot()) == "no robot yet"
    assert status_text(ConsoleSnapshot(drive=DriveInfo(topic="/a/cmd_vel"))) == "no command and no odometry yet"


CRUISING = DriveInfo(asked=(1.0, 0.0), final=(1.0, 0.0), actual=(1.0, -0.1), topic="/cmd_vel")
STATES = {
    "DRIVING": CRUISING,
    "SLOWED warning_distance": replace(CRUISING, final=(0.6, 0.0), limited_by="warning_distance"),
    "STOPPING emergency_stop_distance": replace(CRUISING, final=(0.0, 0.0), limited_by="emergency_stop_distance"),
    "STOPPED emergency_stop_distance": replace(
        CRUISING, final=(0.0, 0.0), actual=(0.0, 0.0), limited_by="emergency_stop_distance"
    ),
    "STOPPED": DriveInfo(final=(0.0, 0.0), actual=(0.0, 0.0)),
    "SILENT 5 s": DriveInfo(asked=(1.0, 0.0), silent_s=5),
    "ALL STOP held (! releases)": DriveInfo(
        stopped=True, stop_confirmed=True, lockable=True, stopped_here=True, own_stops=frozenset(["ours"])
    ),
}


@pytest.mark.parametrize("state", STATES)
def test_line_begins_with_the_state_of_the_robot(state: str) -> None:
    assert f"{status_text(ConsoleSnapshot(drive=STATES[state]))}  ".startswith(f"{state}  ")


def test_a_link_without_an_answer_and_a_stop_come_before_all_else() -> None:
    silent = ConsoleSnapshot(link=LinkInfo("robot:7447", silent_s=3), drive=CRUISING)
    assert status_text(silent).startswith("NO ANSWER 3 s: everything shown is that old  robot:7447")
    held = status_text(replace(silent, drive=STATES["ALL STOP held (! releases)"]))
    assert held.startswith("ALL STOP held (! releases)") and "NO ANSWER 3 s" in held
    moves = status_text(ConsoleSnapshot(drive=DriveInfo(stopped=True, lockable=True)), columns=78)
    assert moves.startswith("STOP SENT, NOT CONFIRMED: THE ROBOT MAY MOVE")


def test_figures_stay_in_place_whatever_the_state_and_the_speeds_are() -> None:
    drives = (
        CRUISING,
        STATES["SLOWED warning_distance"],
        replace(CRUISING, asked=(-0.04, 0.0), final=(-1.0, 0.0), actual=(0.04, 0.0)),
        replace(CRUISING, actual=(0.0, 0.0)),
    )
    lines = [status_text(ConsoleSnapshot(drive=each, active_profile="indoor")) for each in drives]
    places = {tuple(line.index(word) for word in ("asked", "sent", "robot", "m/s", "indoor")) for line in lines}
    assert len(places) == 1, lines
    assert drive_figures(drives[2]) == ["asked -.04", "sent -1.0", "robot 0.04 m/s     "]


@pytest.mark.parametrize("drive", [each for each in STATES.values() if not each.stopped])
def test_nothing_essential_is_cut_at_80_columns(drive: DriveInfo) -> None:
    counts = MappingProxyType({Severity.ERROR: 2})
    snapshot = ConsoleSnapshot(drive=drive, logs=LogState(counts=counts), active_profile="a_profile_with_a_long_name")
    line = status_text(snapshot, columns=78)
    assert len(line) <= 78 and "2 errors" in line and drive.limited_by in line
    assert drive.actual is None or "robot" in line


def test_the_profile_is_shown_where_there_is_room() -> None:
    slowed = ConsoleSnapshot(drive=STATES["SLOWED warning_distance"], active_profile="indoor")
    assert status_text(slowed, columns=78).endswith("indoor")


def test_topics_missing_in_a_recording_are_named() -> None:
    recording = RecordingInfo("/home/ada/bag", missing=("/a", "/b", "/c", "/tf"))
    assert "● REC bag without /a, /b, /c and 1 more" in status_text(ConsoleSnapshot(recording=recording))
    assert "without" not in status_text(ConsoleSnapshot(recording=RecordingInfo("/home/ada/bag")))


def test_topics_that_are_late_are_named() -> None:
    checks = (RateCheck("/scan", "10 Hz ± 20 %", "4 Hz", True), RateCheck("/odom", "50 Hz ± 20 %", "50 Hz", False))
    assert "⚠ late: /scan 4 Hz" in status_text(ConsoleSnapshot(rate_checks=checks))
    assert "⚠ 1 late" in status_text(ConsoleSnapshot(rate_checks=checks), columns=20)
    assert "late" not in status_text(ConsoleSnapshot(rate_checks=checks[1:]))
