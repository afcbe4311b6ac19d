"""Stops for key presses that are not processed yet hold the robot's lock under separate ids."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot.drive_link import DriveLink
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo
from bot_console.tui.safety.stop_wording import stop_text
from bot_console_robot.safety.emergency_stop import BASE, EmergencyStop
from domains import unused_domain
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Rig:
    """A console's link, and a lock."""

    def __init__(self) -> None:
        self.context = Context()
        self.context.init(["test"], domain_id=unused_domain())
        self.nodes = [Node(name, context=self.context) for name in ("console", "base")]
        self.executor = SingleThreadedExecutor(context=self.context)
        for each in self.nodes:
            self.executor.add_node(each)
        self.stop = EmergencyStop(
            self.nodes[1], Clock(clock_type=ClockType.STEADY_TIME), BASE, "emergency_stop/nobody", lambda: None
        )
        self.link = DriveLink(self.nodes[0])
        lock = (Endpoint(f"/{BASE}", ("diagnostic_msgs/msg/DiagnosticStatus",)),)
        self.link.follow(GraphInfo(nodes=(NodeInfo("/base", publishers=lock),)))
        self.settle()

    def settle(self) -> DriveInfo:
        """Let all messages arrive; return what the console then shows."""
        for _ in range(200):
            self.executor.spin_once(timeout_sec=0)
        return self.link.info(WorldInfo())

    @property
    def locked(self) -> bool:
        return self.stop.lock.held

    def close(self) -> None:
        for each in self.nodes:
            each.destroy_node()
        self.context.try_shutdown()


@pytest.fixture
def rig() -> Iterator[Rig]:
    rig = Rig()
    yield rig
    rig.close()


def test_press_locks_and_is_shown_as_the_stop_of_this_console(rig: Rig) -> None:
    rig.link.hold_early("1")
    info = rig.settle()
    assert rig.locked and info.stopped_here and info.stop_confirmed and info.stop_holder == "this console"
    assert [each.here for each in info.stops] == [True]


def test_early_stop_becomes_the_consoles_own_once_kept_and_each_new_stop_has_another_id(rig: Rig) -> None:
    rig.link.hold_early("1")
    assert rig.settle().own_stops == frozenset()
    rig.link.settle_early("1", keep=True)
    first = rig.link.info(WorldInfo()).own_stops
    assert len(first) == 1
    rig.link.stop(False, "")
    assert rig.link.info(WorldInfo()).own_stops == frozenset()
    rig.link.stop(True, "ALL STOP")
    assert len(rig.settle().own_stops) == 1 and not first & rig.link.info(WorldInfo()).own_stops


def test_text_says_whether_the_stop_key_would_stop_once_more_or_release(rig: Rig) -> None:
    rig.link.hold_early("1")
    assert "(! holds it again)" in stop_text(rig.settle()), "the first press has not had its turn"
    rig.link.settle_early("1", keep=True)
    assert "(! releases)" in stop_text(rig.settle())
    rig.link.hold_early("2")
    assert "(! holds it again)" in stop_text(rig.settle()), "the waiting press releases, the one after it does not"
    rig.link.settle_early("2", keep=False)
    assert "(! releases)" in stop_text(rig.settle())
    rig.link.stop(False, "")
    info = rig.link.info(WorldInfo())
    assert info.stopped and "(being released, ! holds it again)" in stop_text(info), "no lock has answered yet"
    assert not rig.settle().stopped


def test_withdrawn_press_leaves_the_acknowledged_stop_confirmed(rig: Rig) -> None:
    rig.link.stop(True, "ALL STOP")
    assert rig.settle().stop_confirmed
    rig.link.hold_early("1")
    assert not rig.link.info(WorldInfo()).stop_confirmed, "no lock has acknowledged it yet"
    rig.link.settle_early("1", keep=False)
    assert rig.link.info(WorldInfo()).stop_confirmed and rig.settle().stop_confirmed and rig.locked


def test_press_that_was_text_is_withdrawn_and_no_other_stop_is(rig: Rig) -> None:
    rig.link.hold_early("1")
    rig.settle()
    rig.link.settle_early("1", keep=False)
    assert not rig.settle().stopped and not rig.locked
    for other in (lambda: rig.link.hold_early("2"), lambda: rig.link.stop(True, "ALL STOP")):
        other()
        rig.link.hold_early("3")
        rig.settle()
        rig.link.settle_early("3", keep=False)
        assert rig.settle().stopped_here and rig.locked


def test_console_makes_the_stop_of_a_press_its_own_and_releases_it(rig: Rig) -> None:
    rig.link.hold_early("1")
    rig.link.settle_early("1", keep=True)
    rig.link.stop(True, "ALL STOP")
    assert len(rig.settle().stops) == 1
    rig.link.stop(False, "")
    assert not rig.settle().stopped and not rig.locked


def test_stop_of_a_press_that_may_be_text_is_not_the_one_a_person_requested(rig: Rig) -> None:
    rig.link.hold_early("1")
    rig.link.stop(True, "ALL STOP")
    rig.settle()
    rig.link.settle_early("1", keep=False)
    assert rig.settle().stopped_here and rig.locked


def test_release_does_not_affect_the_stop_of_an_unprocessed_press(rig: Rig) -> None:
    rig.link.stop(True, "ALL STOP")
    rig.link.hold_early("1")
    rig.settle()
    rig.link.stop(False, "")
    assert rig.settle().stopped_here and rig.locked


def test_press_that_was_text_is_withdrawn_after_somebody_else_released_an_earlier_stop(rig: Rig) -> None:
    rig.link.hold_early("1")
    rig.link.settle_early("1", keep=True)
    rig.settle()
    other = DriveLink(rig.nodes[1])
    other.follow(GraphInfo(nodes=(NodeInfo("/base", publishers=(
        Endpoint(f"/{BASE}", ("diagnostic_msgs/msg/DiagnosticStatus",)),)),)))  # fmt: skip
    rig.settle()
    other.stop(False, "", [each.key for each in other.info(WorldInfo()).stops])
    assert not rig.settle().stops
    rig.link.hold_early("2")
    rig.settle()
    rig.link.settle_early("2", keep=False)
    assert not rig.settle().stopped and not rig.locked
