"""The robot's nodes are composed in one process: each is started, killed and restarted alone, and delays no other."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import pytest
import rclpy
from bot_console.runtime.process import NodeProcess
from bot_console.runtime.workspace.executables import executables
from bot_console.runtime.workspace.program import program
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from sensor_msgs.msg import LaserScan
from systems import System, system

PACKAGE = "bot_console_robot"
NODES = {
    "simulator_node": "/simulator",
    "safety_node": "/safety_monitor",
    "controller_node": "/motion_controller",
    "robot_node": "/robot_navigator",
    "sensor_node": "/sensor_handler",
    "telemetry_node": "/telemetry_publisher",
}
"""The composed executables and their nodes."""
LOCKS = {"safety_node": "/safety_monitor", "simulator_node": "/simulator"}
MOVING, STANDING = 0.2, 0.02
"""Speeds (m/s) above which the robot drives, and below which odometry counts as at rest."""
MESSAGES = 20
"""Messages of each node that arrive while another node hangs."""
TIMEOUT_S = 240.0
"""Timeout in seconds; an idle machine needs one second."""


@pytest.fixture
def running() -> Iterator[System]:
    """An empty system in stepped time."""
    with system() as made:
        yield made


def nodes(running: System) -> set[str]:
    """The names of the nodes that are in the graph."""
    return set(running.ask("node", "list").stdout.split())


def test_each_node_is_killed_and_restarted_alone(running: System) -> None:
    programs = {name: running.executable(PACKAGE, name) for name in NODES}
    running.run(1.0)
    for name, node in NODES.items():
        assert nodes(running) == set(NODES.values())
        programs[name].process.kill()
        running.run(0.1)
        assert programs[name].exit == -9
        assert nodes(running) == set(NODES.values()) - {node}
        programs[name] = running.executable(PACKAGE, name)
        running.run(1.0)
    assert nodes(running) == set(NODES.values())
    assert [each.exit for each in programs.values()] == [None] * len(NODES)


@pytest.mark.parametrize("ended", LOCKS)
def test_if_one_lock_ends_the_other_holds(running: System, ended: str) -> None:
    """The remaining or restarted robot stands although somebody drives its base."""
    speeds: list[float] = []
    programs = {name: running.executable(PACKAGE, name) for name in LOCKS}
    running.compose("driver", driver, ["driver"])
    running.compose("witness", lambda: witness(speeds), ["witness"])
    running.run(3.0)
    assert speeds[-1] > MOVING
    (other,) = LOCKS.keys() - {ended}
    assert "locked" in running.ask("service", "call", f"{LOCKS[ended]}/stop", "std_srvs/srv/Trigger").stdout
    programs[ended].process.kill()
    running.run(1.0)
    if ended == "simulator_node":
        programs[ended] = running.executable(PACKAGE, ended)
        running.run(1.0)
    speeds.clear()
    running.run(3.0)
    assert programs[other].exit is None
    assert speeds and max(speeds) < STANDING


def driver() -> None:
    """A program that drives the base directly, without the safety monitor."""
    rclpy.init()
    node = rclpy.create_node("driver")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    command = Twist()
    command.linear.x, command.angular.z = 0.5, 0.8
    node.create_timer(0.05, lambda: publisher.publish(command))
    rclpy.spin(node)


def witness(speeds: list[float]) -> None:
    """A program that records the speed of the base."""
    rclpy.init()
    node = rclpy.create_node("witness")
    node.create_subscription(Odometry, "odom", lambda message: speeds.append(abs(message.twist.twist.linear.x)), 10)
    rclpy.spin(node)


class CallCounter:
    """Counts calls; the counts can be waited for."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}
        self._changed = threading.Condition()

    def __call__(self, name: str) -> None:
        with self._changed:
            self._counts[name] = self._counts.get(name, 0) + 1
            self._changed.notify_all()

    def reach(self, names: list[str], more: int) -> bool:
        """Wait until each of these was counted `more` times from now on."""
        with self._changed:
            wanted = {name: self._counts.get(name, 0) + more for name in names}
            return self._changed.wait_for(
                lambda: all(self._counts.get(name, 0) >= count for name, count in wanted.items()), TIMEOUT_S
            )


def spinning(make: Callable[[Any], object]) -> Callable[[], None]:
    """A program that makes the entities of a node and spins it."""

    def run() -> None:
        rclpy.init()
        node = rclpy.create_node("other")
        make(node)
        with suppress(ExternalShutdownException, KeyboardInterrupt):
            rclpy.spin(node)

    return run


def test_callback_that_hangs_delays_neither_monitor_nor_simulator() -> None:
    """In real time: each composed executable has a separate executor thread."""
    count, hanging, release = CallCounter(), threading.Event(), threading.Event()

    def hang(_scan: LaserScan) -> None:
        hanging.set()
        release.wait()

    def steer_and_observe(node: Any) -> None:
        node.create_subscription(Odometry, "odom", lambda _message: count("odom"), 10)
        node.create_subscription(Twist, "cmd_vel", lambda _message: count("cmd_vel"), 10)
        steering = node.create_publisher(Twist, "cmd_vel_teleop", 10)
        node.create_timer(0.05, lambda: steering.publish(Twist()))

    programs = {name: program(executables(PACKAGE)[name]) for name in LOCKS}
    programs |= {
        "hangs": spinning(lambda node: node.create_subscription(LaserScan, "scan", hang, 10)),
        "steers": spinning(steer_and_observe),
    }
    processes: list[NodeProcess] = []
    try:
        for name, target in programs.items():
            assert target is not None
            processes.append(NodeProcess(name))
            processes[-1].start(target, argv=[name], stdout=lambda _line: None, stderr=lambda _line: None)
        assert hanging.wait(TIMEOUT_S)
        assert count.reach(["odom", "cmd_vel"], MESSAGES)
        assert not release.is_set() and all(each.is_alive for each in processes)
    finally:
        release.set()
        for each in processes:
            each.stop()
