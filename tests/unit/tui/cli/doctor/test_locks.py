"""The doctor says that an emergency stop answers only if every lock has answered, and its requests change nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from bot_console.tui.cli.doctor.command_timeout import base_finding
from bot_console.tui.cli.doctor.finding import Level
from bot_console.tui.console.robot.stop_link import LATCHED
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, REQUESTS, EmergencyStop
from bot_console_robot.safety.stop_messages import parse_request
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from domains import unused_domain
from geometry_msgs.msg import Twist
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

TURNS = 40
"""Turns of the executor for each wait of the doctor, so that no wall time is measured."""


class Bench:
    """The doctor's node, and a robot with a base that obeys velocities."""

    def __init__(self) -> None:
        self.context = Context()
        self.context.init([], domain_id=unused_domain())
        self.executor = SingleThreadedExecutor(context=self.context)
        self.nodes: list[Node] = []
        self.doctor = self.node("_doctor")
        self.base = self.node("base")
        self.base.create_subscription(Twist, "/cmd_vel", lambda message: None, 10)

    def node(self, name: str, *, frozen: bool = False) -> Node:
        made = Node(name, context=self.context)
        self.nodes.append(made)
        if not frozen:
            self.executor.add_node(made)
        return made

    def lock(self, node: Node, own: str, other: str) -> EmergencyStop:
        return EmergencyStop(node, Clock(clock_type=ClockType.STEADY_TIME), own, other, lambda: None)

    def older_lock(self, node: Node) -> None:
        """A lock that does not quote requests; like those of earlier releases, it locks at an unknown verb."""
        states = node.create_publisher(DiagnosticStatus, BASE, LATCHED)

        def report(locked: str) -> None:
            states.publish(DiagnosticStatus(values=[KeyValue(key="locked", value=locked)]))

        def requested(message: DiagnosticStatus) -> None:
            if parse_request(message).verb not in ("release", "steer", "hand_back"):
                report("true")

        report("false")
        node.create_subscription(DiagnosticStatus, REQUESTS, requested, 10)

    def spin(self, node: Node, seconds: float, until: Callable[[], bool] = lambda: False) -> None:
        for _ in range(TURNS):
            if not until():
                self.executor.spin_once(timeout_sec=0)


@pytest.fixture
def bench(monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    made = Bench()
    monkeypatch.setattr("bot_console.tui.cli.doctor.command_timeout.spin_for", made.spin)
    yield made
    for each in made.nodes:
        each.destroy_node()
    made.context.try_shutdown()


def test_asking_locks_changes_nothing(bench: Bench) -> None:
    monitor = bench.lock(bench.node("safety_monitor"), ARBITER, BASE)
    base = bench.lock(bench.base, BASE, ARBITER)
    base.stop("base", "a reason")
    bench.spin(bench.doctor, 0)
    before = (monitor.lock, base.lock)
    found = base_finding(bench.doctor)
    assert found.level is Level.OK and "has an emergency stop that answers" in found.text
    assert "/emergency_stop/arbiter of /safety_monitor, /emergency_stop/base of /base" in found.text
    assert (monitor.lock, base.lock) == before and before[0].held, "it caused neither a stop nor a release"


@pytest.mark.parametrize("locked", [False, True])
def test_hanging_lock_fails_though_its_last_report_is_latched(bench: Bench, locked: bool) -> None:
    bench.lock(bench.base, BASE, ARBITER)
    hangs = bench.lock(bench.node("safety_monitor", frozen=True), ARBITER, BASE)
    if locked:
        hangs.stop("safety_monitor", "its own reason")
    found = base_finding(bench.doctor)
    assert found.level is Level.FAIL and found.hint
    assert "does not answer (/emergency_stop/arbiter of /safety_monitor)" in found.text


def test_topic_without_publisher_is_not_an_emergency_stop(bench: Bench) -> None:
    bench.base.create_subscription(DiagnosticStatus, ARBITER, lambda message: None, LATCHED)
    bench.base.create_publisher(DiagnosticStatus, REQUESTS, 10)
    found = base_finding(bench.doctor)
    assert found.level is Level.WARN and "emergency stop that answers" not in found.text


def test_publisher_that_never_reported_fails(bench: Bench) -> None:
    bench.base.create_publisher(DiagnosticStatus, BASE, LATCHED)
    assert base_finding(bench.doctor).level is Level.FAIL


def test_older_lock_is_queried_through_its_node_and_left_unchanged(bench: Bench) -> None:
    bench.older_lock(bench.base)
    states: list[str] = []
    bench.doctor.create_subscription(
        DiagnosticStatus, BASE, lambda message: states.append(message.values[0].value), LATCHED
    )
    assert base_finding(bench.doctor).level is Level.OK
    assert states == ["false"]


def test_older_lock_with_hanging_node_fails(bench: Bench) -> None:
    bench.older_lock(bench.node("old_base", frozen=True))
    found = base_finding(bench.doctor)
    assert found.level is Level.FAIL and "/emergency_stop/base of /old_base" in found.text


def test_every_robot_is_queried(bench: Bench) -> None:
    for space in ("/robot1", "/robot2"):
        node = Node("base", context=bench.context, namespace=space)
        bench.nodes.append(node)
        bench.lock(node, BASE, ARBITER)
        if space == "/robot1":
            bench.executor.add_node(node)
    found = base_finding(bench.doctor)
    assert found.level is Level.FAIL and "/robot2/emergency_stop/base" in found.text and "/robot1" not in found.text
