"""The emergency stop of a node on the graph: what it observes, and what it does not."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from bot_console.runtime.rmw.local import LocalBus
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, GONE_AFTER_CHECKS, EmergencyStop
from domains import unused_domain
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Rig:
    """A base and its safety monitor."""

    def __init__(self) -> None:
        self.context = Context()
        self.context.init(["test"], domain_id=unused_domain())
        self.executor = SingleThreadedExecutor(context=self.context)
        self.monitor = self.node("safety_monitor")
        self.stops = [self.stop(self.node("simulator"), BASE, ARBITER), self.stop(self.monitor, ARBITER, BASE)]

    def node(self, name: str) -> Node:
        made = Node(name, context=self.context)
        self.executor.add_node(made)
        return made

    def stop(self, node: Node, own: str, other: str) -> EmergencyStop:
        return EmergencyStop(node, Clock(clock_type=ClockType.STEADY_TIME), own, other, lambda: None)

    def settle(self, polls: int = 0) -> EmergencyStop:
        """The base, after `polls` of its checks for the monitor."""
        for _ in range(polls):
            self.stops[0]._watch()
        for _ in range(30):
            self.executor.spin_once(timeout_sec=0)
        return self.stops[0]


@pytest.fixture
def rig() -> Iterator[Rig]:
    made = Rig()
    yield made
    for each in made.executor.get_nodes():
        each.destroy_node()
    made.context.try_shutdown()


def test_base_locks_some_checks_after_its_monitor_has_gone(rig: Rig) -> None:
    assert not rig.settle().lock.held
    assert not rig.settle(polls=2 * GONE_AFTER_CHECKS).lock.held
    rig.executor.remove_node(rig.monitor)
    rig.monitor.destroy_node()
    assert not rig.settle(polls=GONE_AFTER_CHECKS - 1).lock.held
    rig.settle(polls=GONE_AFTER_CHECKS)
    assert rig.stops[0].lock.reason == "the safety monitor has gone"


def test_lock_does_not_follow_the_graph(rig: Rig, monkeypatch: pytest.MonkeyPatch) -> None:
    def never(self: LocalBus) -> None:
        raise AssertionError("the graph was asked for")

    rig.settle()
    monkeypatch.setattr(LocalBus, "tables", never)
    rig.settle(polls=GONE_AFTER_CHECKS)
    rig.stops[0].stop("somebody", "a test")
    assert rig.settle(polls=GONE_AFTER_CHECKS).lock.held
