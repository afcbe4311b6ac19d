"""A read-only console refuses everything that would change something, with the reason."""

from __future__ import annotations

from typing import Any, cast

import pytest
from bot_console.tui.console.command_gate import READ_ONLY, Gate
from bot_console.tui.console.command_line import Stream
from bot_console.tui.console.gated_command_line import GatedCommandLine
from bot_console.tui.console.launch.gated_launcher import GatedLauncher
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.console.running_line import RunningLine
from fakes.command_line import FakeCommandLine
from fakes.launcher import FakeLauncher


@pytest.fixture
def gate() -> Gate:
    gate = Gate("")
    gate.read_only = READ_ONLY
    return gate


def test_commands_are_refused_in_every_state_and_the_snapshot_shows_it() -> None:
    console = RosConsole()
    console.refuse_changes()
    assert console.snapshot() is console.snapshot()
    assert console.snapshot().drive.refused == console.snapshot().capabilities.change == READ_ONLY
    [outcome] = console.parameters.set("/n", {"a": 99}).result(0)
    assert (outcome.accepted, outcome.reason) == (False, READ_ONLY)
    answers = [console.parameters.undo(), console.parameters.redo()]
    answers += [console.topics.call_service("/reset", "std_srvs/srv/Trigger", {})]
    assert [(each.result(0).ok, each.result(0).text) for each in answers] == [(False, READ_ONLY)] * 3
    assert not console.topics.publish("/t", "std_msgs/msg/String", {}).ok
    with pytest.raises(ValueError, match="read-only"):
        console.profiles.apply("indoor").result(0)


@pytest.mark.parametrize("verb", ["start", "stop", "kill", "restart"])
def test_no_process_can_be_started_or_ended(verb: str, gate: Gate) -> None:
    behind = FakeLauncher((), ("x.launch.py",))
    launcher: Launcher = GatedLauncher(gate, behind)
    assert getattr(launcher, verb)("a").result(0).text == READ_ONLY
    assert launcher.launch("x.launch.py", {}).result(0).text == READ_ONLY
    with pytest.raises(ValueError, match="read-only"):
        launcher.arguments("x.launch.py")
    assert launcher.files() == () and behind.asked == []


@pytest.mark.parametrize(
    ("line", "runs"),
    [
        ("ros2 topic echo --once /odom", True),
        ("node list", True),
        ("param get /a b", True),
        ("ros2 param set /a b 1", False),
        ("topic pub /cmd_vel geometry_msgs/msg/Twist {}", False),
        ("run my_package node", False),
        ("service call /reset std_srvs/srv/Trigger", False),
        ("param load /a file.yaml", False),
        ("'", True),
        ("", False),
    ],
)
def test_only_lines_that_read_are_run(line: str, runs: bool, gate: Gate) -> None:
    asked: list[tuple[Any, ...]] = []
    lines = GatedCommandLine(gate, FakeCommandLine(asked))
    answer = lines.run(line)
    assert bool(asked) is runs and (runs or READ_ONLY in answer.result(0))


@pytest.mark.parametrize(("line", "runs"), [("topic hz /odom", True), ("action send_goal /go pkg/action/Go {}", False)])
def test_only_lines_that_read_keep_running(line: str, runs: bool, gate: Gate) -> None:
    class Streaming(FakeCommandLine):
        def stream(self, line: str) -> Stream | None:
            return cast("Stream", RunningLine())

    assert bool(GatedCommandLine(gate, Streaming([])).stream(line)) is runs
