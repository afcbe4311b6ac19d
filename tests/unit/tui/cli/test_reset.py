"""`bot-console reset`: what is reset, in which order, and which failures are reported."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from bot_console.tui.cli.verbs import reset
from bot_console.tui.console.model import Endpoint
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.console.robot.stop_link import StopInfo
from fakes.console import FakeConsole
from samples import live

NAVIGATOR, SIMULATOR = "/robot_navigator", "/simulator"
TRIGGER = ("std_srvs/srv/Trigger",)


class Robot(FakeConsole):
    """The sample system, with known start values."""

    def start_values(self) -> dict[tuple[str, str], Any]:
        return {(NAVIGATOR, "max_speed"): 2.0, (NAVIGATOR, "turn_rate"): 1.0, (SIMULATOR, "seed"): 9}


@pytest.fixture
def robot(monkeypatch: pytest.MonkeyPatch) -> Robot:
    made = Robot(live()[0].current)

    def stop(verb: str, reason: str) -> tuple[bool, StopInfo]:
        made.stop(True, reason)
        return True, StopInfo(locks=2)

    monkeypatch.setattr(reset, "ask", stop)
    services = (
        Endpoint("/reset", TRIGGER),
        Endpoint("/pause", ("std_srvs/srv/SetBool",)),
        Endpoint("/odd/reset", TRIGGER),
    )
    made.change(graph=replace(made.current.graph, services=services), drive=DriveInfo(lockable=True))
    return made


def test_reset_locks_robot_first_then_sets_parameters_then_simulator(robot: Robot, capsys: Any) -> None:
    assert reset._reset(robot, dry=False) == 0
    assert robot.asked == [
        ("all_stop", True),
        ("set_all", {NAVIGATOR: {"max_speed": 2.0}}, "reset"),
        ("call", "/reset"),
    ], "a service that is only called reset is not called, and read-only parameters are not set"
    assert robot.current.drive.stopped, "it stays locked"
    message = capsys.readouterr().out
    assert "/robot_navigator max_speed: 1.0 -> 2.0" in message and "bot-console release releases it" in message


def test_refusal_leaves_all_parameters_and_sets_exit_code(robot: Robot, capsys: Any) -> None:
    robot.refusals[NAVIGATOR, "max_speed"] = "not while driving"
    assert reset._reset(robot, dry=False) == 1
    message = capsys.readouterr().err
    assert "not while driving" in message and "no parameter was reset" in message
    assert robot.current.drive.stopped


def test_dry_run_changes_nothing(robot: Robot, capsys: Any) -> None:
    assert reset._reset(robot, dry=True) == 0
    assert robot.asked == [] and "max_speed: 1.0 -> 2.0" in capsys.readouterr().out


def test_nodes_with_unknown_start_values_are_named() -> None:
    snapshot = live()[0].current
    moved, untold = reset.differing(snapshot, {(NAVIGATOR, "max_speed"): 1.0})
    assert (moved, untold) == ({}, [SIMULATOR])
