"""A read-only console refuses everything that would change something, with the reason."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.tui.console.connection.no_console import NoCommandLine
from bot_console.tui.console.connection.read_only import WHY, ReadOnlyCommandLine, ReadOnlyConsole, ReadOnlyLauncher
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Launcher
from fakes.console import FakeConsole
from samples import navigator


@pytest.fixture
def fake() -> FakeConsole:
    return FakeConsole(ConsoleSnapshot(parameters={"/robot_navigator": navigator()}))


def test_everything_can_be_read_and_nothing_changed(fake: FakeConsole) -> None:
    reported: list[str] = []
    console = ReadOnlyConsole(fake, reported.append)
    assert console.snapshot() is console.snapshot() and console.snapshot().graph is fake.snapshot().graph
    assert console.snapshot().drive.refused == console.snapshot().capabilities.change == WHY
    fake.change(problem="another snapshot")
    before = console.snapshot().capabilities
    fake.change(problem="")
    assert console.snapshot().capabilities is before, "what is the same needs not be drawn again"
    node = next(iter(fake.snapshot().parameters))
    name = fake.snapshot().parameters[node].parameters[0].name
    before = fake.snapshot().parameters
    [outcome] = console.set_parameters(node, {name: 99}).result(0)
    assert (outcome.accepted, outcome.reason) == (False, WHY)
    for answer in (console.undo(), console.redo(), console.call("/reset", "std_srvs/srv/Trigger", {})):
        assert (answer.result(0).ok, answer.result(0).text) == (False, WHY)
    with pytest.raises(ValueError, match="read-only"):
        console.apply_profile("indoor").result(0)
    console.drive(1.0, 0.0)
    console.steer(True)
    assert fake.snapshot().parameters is before
    assert fake.asked == []


def test_the_robot_can_be_stopped_but_not_released(fake: FakeConsole) -> None:
    reported: list[str] = []
    console = ReadOnlyConsole(fake, reported.append)
    console.all_stop(True)
    assert fake.snapshot().drive.stopped
    console.all_stop(False)
    console.release(["another"])
    assert fake.snapshot().drive.stopped and len(reported) == 2 and WHY in reported[0]
    assert fake.asked == [("all_stop", True)]


@pytest.mark.parametrize("verb", ["start", "stop", "kill", "restart"])
def test_no_process_can_be_started_or_ended(verb: str) -> None:
    launcher: Launcher = ReadOnlyLauncher()
    assert getattr(launcher, verb)("a").result(0).text == WHY
    assert launcher.launch("x.launch.py", {}).result(0).text == WHY
    with pytest.raises(ValueError, match="read-only"):
        launcher.arguments("x.launch.py")


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
def test_only_lines_that_read_are_run(line: str, runs: bool) -> None:
    ran: list[str] = []

    class Lines(NoCommandLine):
        def run(self, line: str) -> Any:
            ran.append(line)
            return super().run(line)

    answer = ReadOnlyCommandLine(Lines()).run(line)
    assert bool(ran) is runs and (runs or WHY in answer.result(0))
