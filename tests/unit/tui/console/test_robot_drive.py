"""Stops that are requested while there is no link to the robot."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, cast

from bot_console.tui.console.command_gate import STARTING
from bot_console.tui.console.model import LinkInfo
from bot_console.tui.console.robot.drive_link import BY_PERSON
from bot_console.tui.console.robot.robot_drive import NO_WORLD, RobotDrive
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.safety.quitting import REASON


def drive_over(link: SimpleNamespace, network: Callable[[], LinkInfo] = LinkInfo) -> RobotDrive:
    gate, node = SimpleNamespace(read_only="", refusal="", unreached=STARTING), SimpleNamespace(link=link)
    return RobotDrive(
        cast(Any, gate), lambda: cast(Any, node), network=network, on_stop=lambda: None, report=lambda text: None
    )


def stops_sent_on_connection(*requests: tuple[bool, str]) -> list[tuple[bool, str]]:
    sent: list[tuple[bool, str]] = []
    drive = drive_over(SimpleNamespace(stop=lambda hold, reason: sent.append((hold, reason))))
    for hold, reason in requests:
        drive.stop(hold, reason)
    drive.connect()
    return sent


def test_automatic_stop_does_not_replace_a_persons_stop_that_is_waiting_for_the_link() -> None:
    """Only the person's stop outlives the robot's nodes."""
    person, own = (True, BY_PERSON), (True, REASON)
    assert stops_sent_on_connection(person, own, person) == [person, own]
    assert stops_sent_on_connection(own, person) == [own, person]


def test_release_replaces_the_stops_that_wait_for_the_link() -> None:
    assert stops_sent_on_connection((True, BY_PERSON), (False, "")) == [(False, "")]
    assert stops_sent_on_connection((True, BY_PERSON), (False, ""), (True, REASON)) == [(True, REASON)]


def test_robot_that_was_never_found_is_not_absent_while_the_link_is_silent() -> None:
    stopped, silent_s = DriveInfo(stopped=True, stopped_here=True), 5
    drive = drive_over(SimpleNamespace(info=lambda world: stopped), lambda: LinkInfo(silent_s=silent_s))
    drive.connect()
    assert drive.info(NO_WORLD).awaits_robot and drive.info(NO_WORLD) is drive.info(NO_WORLD)
    silent_s = 0
    assert drive.info(NO_WORLD).nothing_to_stop
