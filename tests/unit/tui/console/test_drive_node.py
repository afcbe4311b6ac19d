"""Reports of the robot's lock are processed while the console's own thread is busy."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.widgets.status_bar import status_text
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, EmergencyStop
from domains import unused_domain
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rigs import TIMEOUT_S, until


@pytest.fixture
def console(shared_context: Context) -> Iterator[RosConsole]:
    """A console connected to a base with a lock."""
    node = Node("simulator", context=shared_context)
    EmergencyStop(node, Clock(clock_type=ClockType.STEADY_TIME), BASE, ARBITER, lambda: None)
    executor = SingleThreadedExecutor(context=shared_context)
    executor.add_node(node)
    spinning = threading.Thread(target=executor.spin, daemon=True)
    spinning.start()
    made = RosConsole()
    made.start()
    assert made.wait_ready(TIMEOUT_S)
    yield made
    made.close()
    executor.shutdown()
    spinning.join(TIMEOUT_S)
    node.destroy_node()


def test_stop_and_release_are_acknowledged_during_a_long_graph_poll(
    console: RosConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    until(lambda: console.snapshot().drive.lockable, "the lock")
    watching, over = threading.Event(), threading.Event()

    def poll(self: GraphWatch) -> None:
        watching.set()
        over.wait(TIMEOUT_S)

    monkeypatch.setattr(GraphWatch, "poll", poll)
    assert watching.wait(TIMEOUT_S)
    try:
        console.drive.stop()
        until(lambda: console.snapshot().drive.stop_confirmed, "the acknowledgement")
        console.drive.stop(False)
        until(lambda: not console.snapshot().drive.stopped, "the release")
        assert not over.is_set()
    finally:
        over.set()


def test_stop_is_pending_until_the_graph_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    console = RosConsole()
    console.drive.connect()
    try:
        console.drive.stop()
        assert "STOP NOT CONFIRMED: looking for the robot" in status_text(console.snapshot())
    finally:
        console.close()
