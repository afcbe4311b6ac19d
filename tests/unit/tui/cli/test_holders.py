"""Who holds a robot, as printed by `bot-console status`."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.cli.verbs import background, stop
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.console.robot.stop_link import FOLDER, LATCHED, StopInfo
from bot_console.tui.session.machine import machine_ros
from bot_console.tui.session.machine.machine_ros import MachineRos
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from domains import unused_domain
from rclpy.context import Context
from rclpy.node import Node
from rclpy.publisher import Publisher


@pytest.fixture
def lock_publisher(monkeypatch: pytest.MonkeyPatch) -> Iterator[Publisher]:
    """The publisher of a robot's emergency stop, which has published nothing yet."""
    number = unused_domain()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
    context = Context()
    context.init([], domain_id=number)
    node = Node("monitor", context=context)
    yield node.create_publisher(DiagnosticStatus, f"{FOLDER}monitor", LATCHED)
    node.destroy_node()
    context.try_shutdown()


def test_silent_lock_does_not_count_as_free(lock_publisher: Publisher) -> None:
    assert stop.holders(to_hear=0.0) is None
    lock_publisher.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="false")]))
    assert stop.holders() == []


def test_status_reports_robot_that_does_not_answer(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(background, "holders", lambda: None)
    background._print_holders()
    assert capsys.readouterr().out == "it is unknown whether somebody holds it: its emergency stop did not answer\n"


def test_status_names_who_holds_a_robot_in_a_namespace(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its nodes have other names than those of a robot without a namespace."""
    for name, value in {"reach_system": "", "_running_system": None, "running_robot_nodes": [], "frozen": []}.items():
        monkeypatch.setattr(background, name, lambda value=value: value)
    monkeypatch.setattr(background, "holders", lambda: ["anna: my foot"])
    monkeypatch.setattr(background, "others_take_part", lambda: True)
    assert background.status([]) == 0
    assert capsys.readouterr().out == "held by anna: my foot; bot-console release --all releases it\n"
    monkeypatch.setattr(background, "others_take_part", lambda: False)
    assert background.status([]) == 1


@pytest.mark.parametrize("ros", [None, MachineRos(Path("/opt/ros/rclpy"))])
def test_status_of_an_empty_domain_refers_to_the_ros2_of_the_machine(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], ros: MachineRos | None
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setattr(machine_ros, "find_machine_ros", lambda: ros)
    assert background.status([]) == 1
    assert ("attach --ros" in capsys.readouterr().err) == (ros is not None)


def test_nobody_holds_a_robot_that_does_not_exist(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    assert stop.holders(to_find=0.0) == []


def test_release_after_which_a_node_holds_the_robot_names_the_node(capsys: pytest.CaptureFixture[str]) -> None:
    """A lock that answers, but cannot write its stop file, stops the robot for this reason."""
    full = RobotStop("n1", "simulator", "stops cannot be kept: No space left on device", by_node=True)
    assert stop._report("release", False, StopInfo(stopped=True, locks=2, stops=(full,))) == 1
    assert capsys.readouterr().err == f"not released: still held by simulator: {full.reason}\n"
    assert stop._report("release", False, StopInfo(stopped=True, locks=2, stops=(replace(full, by_node=False),))) == 1
    assert capsys.readouterr().err == "not released: it did not answer\n"


def test_reason_that_all_locks_give_is_printed_once(capsys: pytest.CaptureFixture[str]) -> None:
    full = [RobotStop(who, who, "no space left", by_node=True) for who in ("safety_monitor", "simulator")]
    info = StopInfo(stopped=True, locks=2, stops=(*full, RobotStop("a", "anna", "lunch")))
    stop._report("release", False, info)
    assert capsys.readouterr().err.endswith("still held by safety_monitor, simulator: no space left; anna: lunch\n")
