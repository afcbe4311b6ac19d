"""No message ends a node of the robot, and messages that the safety monitor cannot use never let the robot drive on."""

from __future__ import annotations

import math
import random
from array import array
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rclpy
from bot_console_robot.controller_node import MotionController
from bot_console_robot.robot_node import RobotNavigator
from bot_console_robot.safety.obstacle_ahead import nearest_ahead
from bot_console_robot.safety_node import LOCKED, NAVIGATION, SafetyMonitor
from bot_console_robot.sensor_node import SensorHandler
from bot_console_robot.simulator_node import Simulator
from bot_console_robot.telemetry_node import TelemetryPublisher
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from domains import unused_domain
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry, Path
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan

A_FEW, MANY = 400, 100_000
NUMBERS = (0.0, -0.0, 1.0, -1.0, 1e-300, 1e308, -1e308, 3e38, math.pi, math.nan, math.inf, -math.inf)
FLOATS = tuple(each for each in NUMBERS if not math.isfinite(each) or abs(each) < 3.4e38)


@pytest.fixture(autouse=True)
def ros() -> Iterator[None]:
    rclpy.init(domain_id=unused_domain())
    yield
    rclpy.try_shutdown()


def number(chance: random.Random) -> float:
    return chance.choice((*NUMBERS, chance.uniform(-5.0, 5.0), chance.gauss(0.0, 1e6)))


def float32(chance: random.Random) -> float:
    """A number that a float32 field can hold."""
    return chance.choice((*FLOATS, chance.uniform(-5.0, 5.0), chance.uniform(0.0, 0.02)))


def floats(chance: random.Random) -> array[float]:
    count = chance.choice((0, 1, 2, 3, 180, 360, 361, 1000))
    values = [float32(chance) for _ in range(min(count, 7))] or [0.0]
    return array("f", (values * (count // len(values) + 1))[:count])


def stamp(message: Any, chance: random.Random) -> Any:
    message.header.stamp.sec = chance.choice((0, 1, 100, -5, 2**31 - 1, -(2**31)))
    message.header.stamp.nanosec = chance.choice((0, 1, 999_999_999, 2**32 - 1))
    return message


def scan(chance: random.Random) -> LaserScan:
    message = stamp(LaserScan(), chance)
    for name in ("angle_min", "angle_max", "angle_increment", "time_increment", "scan_time", "range_min", "range_max"):
        setattr(message, name, float32(chance))
    message.ranges, message.intensities = floats(chance), floats(chance)
    return message


def twist(chance: random.Random) -> Twist:
    message = Twist()
    message.linear.x, message.angular.z, message.linear.y = number(chance), number(chance), number(chance)
    return message


def place(pose: Any, chance: random.Random) -> None:
    pose.position.x, pose.position.y = number(chance), number(chance)
    for name in "xyzw":
        setattr(pose.orientation, name, number(chance))


def odometry(chance: random.Random) -> Odometry:
    message = stamp(Odometry(), chance)
    place(message.pose.pose, chance)
    message.twist.twist.linear.x, message.twist.twist.angular.z = number(chance), number(chance)
    return message


def goal(chance: random.Random) -> PoseStamped:
    message = PoseStamped()
    place(message.pose, chance)
    return message


def request(chance: random.Random) -> DiagnosticStatus:
    text = lambda: chance.choice(("", "stop", "release", "steer", "hand_back", "locked", "x" * 5000, "\x00\x1b[2J"))  # noqa: E731
    keys = ("request", "locked", "turn", "holder", "instance", "")
    values = [KeyValue(key=chance.choice(keys), value=text()) for _ in range(chance.randrange(6))]
    return DiagnosticStatus(level=bytes([chance.randrange(256)]), name=text(), message=text(), values=values)


def clock(chance: random.Random) -> Clock:
    message = Clock()
    message.clock.sec, message.clock.nanosec = chance.choice((0, 7, -5, 2**31 - 1)), chance.randrange(2**32)
    return message


def monitor(chance: random.Random) -> Callable[[], None]:
    node = SafetyMonitor()
    sent: list[tuple[float, float]] = []
    node._commands.publish = lambda command: sent.append((command.linear.x, command.angular.z))
    teleop, navigation, stop = node._listener("cmd_vel_teleop"), node._listener(NAVIGATION), node._stop

    def once() -> None:
        chance.choice((
            lambda: node._on_scan(scan(chance)), lambda: navigation(twist(chance)), lambda: teleop(twist(chance)),
            lambda: stop._on_request(request(chance)), lambda: stop._on_state(request(chance)), stop._watch,
            lambda: node._robot_time._on_clock(clock(chance)), node._watch,
        ))()  # fmt: skip
        assert all(math.isfinite(value) for command in sent for value in command)
        if stop.lock.held or not node._scan.fresh:
            node._watch()
            assert node._verdict.final == (0.0, 0.0) and sent[-1:] in ([], [(0.0, 0.0)])
        if stop.lock.held:
            assert node._verdict.limited_by == LOCKED
        sent.clear()

    return once


def other(make: Callable[[], Any], *callbacks: tuple[str, Callable[[random.Random], Any]]) -> Any:
    def play(chance: random.Random) -> Callable[[], None]:
        node = make()

        def once() -> None:
            name, message = chance.choice(callbacks)
            getattr(node, name)(*(() if message is None else (message(chance),)))
            assert isinstance(node, MotionController) is False or math.isfinite(node._velocity.linear), (
                "the node never recovers"
            )

        return once

    return play


def route(chance: random.Random) -> Path:
    return Path(poses=[goal(chance) for _ in range(chance.randrange(4))])


PLAYS = {
    "safety_monitor": monitor,
    "motion_controller": other(
        MotionController, ("_on_odometry", odometry), ("_on_desired", twist), ("_on_goal", goal), ("_control", None),
        ("_on_route", route),
    ),
    "simulator": other(Simulator, ("_on_command", twist), ("_advance", None)),
    "robot_navigator": other(RobotNavigator, ("_on_scan", scan)),
    "sensor_handler": other(SensorHandler, ("_on_scan", scan), ("_process", None)),
    "telemetry_publisher": other(
        TelemetryPublisher, ("_on_odometry", odometry), ("_on_scan", scan), ("_publish", None)
    ),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("count", [A_FEW, pytest.param(MANY, marks=[pytest.mark.soak, pytest.mark.timeout(1200)])])
@pytest.mark.parametrize("name", PLAYS)
def test_nodes_survive_any_message(name: str, count: int) -> None:
    once = PLAYS[name](random.Random(7))
    for _ in range(count):
        once()


@pytest.mark.parametrize("count", [3000, pytest.param(MANY, marks=pytest.mark.soak)])
def test_a_scan_gives_the_distance_ahead_or_nothing(count: int) -> None:
    chance = random.Random(3)
    for _ in range(count):
        message = scan(chance)
        ranges = memoryview(message.ranges)
        found = nearest_ahead(__import__("numpy").frombuffer(ranges, "f4"), message.angle_min, message.angle_increment)
        assert found is None or found >= 0.0
