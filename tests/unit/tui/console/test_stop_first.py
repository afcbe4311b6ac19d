"""The connection that stops the robot is the first of a console, and outlives every other part."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from base_rig import Base, served_base
from bot_console.tui.console.graph.warning_log import GraphWarnings
from bot_console.tui.console.logs.rosout import RosoutWatch
from bot_console.tui.console.model import ChangeSource, LogFilter
from bot_console.tui.console.parameters.history_file import History
from bot_console.tui.console.parameters.journal import Journal
from bot_console.tui.console.parameters.profile_store import ProfileStore
from bot_console.tui.console.robot.drive_link import DriveLink
from bot_console.tui.console.robot.drive_node import DriveNode
from bot_console.tui.console.robot.pose_and_trail import WorldWatch
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.reached_stop import ReachedStop
from bot_console.tui.widgets.status_bar import status_text
from diagnostic_msgs.msg import DiagnosticArray
from rigs import TIMEOUT_S, until


@pytest.fixture
def base(monkeypatch: pytest.MonkeyPatch) -> Iterator[Base]:
    with served_base(monkeypatch) as made:
        yield made


@pytest.fixture
def console(tmp_path: Path) -> Iterator[RosConsole]:
    made = RosConsole(history=tmp_path / "history.sqlite")
    yield made
    made.close()


def broken(*given: object, **named: object) -> None:
    raise RuntimeError("whatever it is")


PARTS: dict[str, tuple[object, str]] = {
    "the history": (History, "__init__"),
    "reading the history": (History, "earlier"),
    "the journal": (Journal, "__init__"),
    "the profiles": (RosConsole, "_profile_store"),
    "the log": (RosoutWatch, "__init__"),
    "the warnings about the graph": (GraphWarnings, "follow"),
    "the profiles, later": (ProfileStore, "reload_if_changed"),
    "everything shown": (WorldWatch, "__init__"),
}


@pytest.mark.parametrize(("owner", "name"), PARTS.values(), ids=PARTS)
def test_a_stop_reaches_the_robot_whatever_else_fails(
    owner: object, name: str, base: Base, console: RosConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(owner, name, broken)
    console.start()
    console.wait_ready(TIMEOUT_S)
    console.drive.stop(True, "a foot under the wheel")
    until(base.is_held, "the lock")
    until(lambda: console.snapshot().drive.stop_confirmed, "the acknowledgement")
    assert "ALL STOP held" in status_text(console.snapshot())
    console.drive.stop(False)
    until(lambda: not base.is_held(), "the release")


def test_log_files_that_cannot_be_written_prevent_no_stop(
    console: RosConsole, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "file" / "log"))
    (tmp_path / "file").write_text("no folder")
    with ReachedStop("_bot_console_stop", "anna") as reached:
        assert reached.info.locks == 0
    console.start()
    assert console.wait_ready(TIMEOUT_S) and console.snapshot().problem == ""


@pytest.mark.parametrize("part", ["the history", "reading the history", "the profiles"])
def test_a_console_connects_without_a_failing_store_and_reports_it_once(
    part: str, base: Base, console: RosConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    owner, name = PARTS[part]
    monkeypatch.setattr(owner, name, broken)
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    until(lambda: console.snapshot().graph.nodes, "the graph")
    assert console.snapshot().problem == ""
    message = [console.logs.record(each) for each in console.logs.matching(LogFilter(), 0)]
    assert sum("whatever it is" in each.text for each in message if each) == 1


def test_a_history_with_an_unreadable_row_is_reported_once_and_ends_nothing(
    base: Base, console: RosConsole, tmp_path: Path
) -> None:
    journal = Journal(history=History(tmp_path / "history.sqlite", 1))
    for number in (1, 2):
        journal.record(number, "/robot", "speed", (0, number), ChangeSource.EDIT)
    journal.close()
    with sqlite3.connect(tmp_path / "history.sqlite") as link:
        link.execute("UPDATE changes SET new = CAST(x'ff' AS TEXT) WHERE number = 1")
    link.close()
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    assert [each.new for each in console.parameters.changes(-10)] == [2]
    message = [console.logs.record(each) for each in console.logs.matching(LogFilter(), 0)]
    assert sum("1 row of the history cannot be read" in each.text for each in message if each) == 1


def test_an_error_in_the_robots_reports_is_logged_once_and_the_link_stays_up(
    base: Base, console: RosConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(DriveLink, "_reported", broken)
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    verdicts = base.node.create_publisher(DiagnosticArray, "/diagnostics", 10)
    until(lambda: verdicts.publish(DiagnosticArray()) or console.snapshot().logs.end, "the report")
    for _ in range(3):
        verdicts.publish(DiagnosticArray())
    console.drive.stop()
    until(base.is_held, "the lock")
    message = [console.logs.record(each) for each in console.logs.matching(LogFilter(), 0)]
    assert sum("whatever it is" in each.text for each in message if each) == 1


@pytest.mark.parametrize(
    ("fails", "message_of"),
    [(False, "STOP NOT SENT: still connecting"), (True, "STOP NOT SENT: not connected")],
)
def test_a_stop_that_cannot_be_sent_is_reported_at_once(
    fails: bool, message_of: str, base: Base, console: RosConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert status_text(console.snapshot()).startswith("no robot yet")
    if fails:
        monkeypatch.setattr(DriveNode, "__init__", broken)
        console.start()
        console.wait_ready(TIMEOUT_S)
    console.drive.stop()
    assert status_text(console.snapshot()).startswith(message_of)
    assert console.snapshot().drive.stopped_here
    console.drive.stop(False)
    assert "STOP" not in status_text(console.snapshot())


def test_closing_while_only_the_stop_is_connected_leaves_no_thread(
    base: Base, console: RosConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WorldWatch, "__init__", broken)
    before = set(threading.enumerate())
    console.start()
    console.wait_ready(TIMEOUT_S)
    console.close()
    for each in set(threading.enumerate()) - before:
        if each.name.startswith("bot-console"):
            each.join(TIMEOUT_S)
            assert not each.is_alive()
