"""ALL STOP holds the robot, whoever publishes velocities and whichever node has ended; a witness judges by odometry."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from bot_console.tui.cli.main import main
from bot_console.tui.cli.verbs import stop
from bot_console.tui.cli.verbs.stop import run
from bot_console.tui.console.robot.stop_link import StopInfo
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.qos import DurabilityPolicy, QoSProfile
from systems import Program, System, kill_composed, system

ROOT = Path(__file__).resolve().parents[3]
MOVING, STANDING = 0.2, 0.02
"""Speeds (m/s) above which the robot drives, and below which odometry counts as at rest."""
BRAKING = 0.5
"""Seconds within which the robot comes to rest."""

WITNESS = """
import rclpy
from nav_msgs.msg import Odometry

rclpy.init()
node = rclpy.create_node("witness")
node.create_subscription(Odometry, "odom", lambda message: print(message.twist.twist.linear.x), 10)
rclpy.spin(node)
"""

DRIVER = """
import sys
import rclpy
from geometry_msgs.msg import Twist

rclpy.init()
node = rclpy.create_node("second_driver")
publisher = node.create_publisher(Twist, sys.argv[1], 10)


def drive():
    command = Twist()
    command.linear.x, command.angular.z = 0.5, 0.8
    publisher.publish(command)


node.create_timer(0.05, drive)
rclpy.spin(node)
"""

STEERS = """
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

rclpy.init()
node = rclpy.create_node("steers")
publisher = node.create_publisher(DiagnosticStatus, "emergency_stop/request", 10)
message = DiagnosticStatus(name="anna", hardware_id="1", values=[KeyValue(key="request", value="steer")])
node.create_timer(0.2, lambda: publisher.publish(message))
rclpy.spin(node)
"""

BLIND = """
import math
import rclpy
from sensor_msgs.msg import LaserScan

rclpy.init()
node = rclpy.create_node("blind")
publisher = node.create_publisher(LaserScan, "scan", 10)
node.create_timer(0.02, lambda: publisher.publish(LaserScan(angle_increment=math.nan, ranges=[1.0] * 9)))
rclpy.spin(node)
"""


class Bench:
    """A launched robot with its witness."""

    def __init__(self, running: System, launch: str) -> None:
        self._running = running
        self.launch = running.ros2("launch", str(ROOT / "launch" / launch))
        self._witness = running.python("-c", WITNESS)
        self.run(3.0)

    def run(self, seconds: float) -> list[float]:
        """Let time pass; return the speeds that the witness saw."""
        seen = len(self._witness.stdout)
        self._running.run(seconds)
        return [abs(float(each)) for each in self._witness.stdout[seen:].split()]

    def drives(self, seconds: float = 3.0) -> bool:
        """Whether the robot drives within this many seconds."""
        return max(self.run(seconds)) > MOVING

    def stands(self, seconds: float = 4.0) -> bool:
        """Whether the robot comes to rest and stays at rest."""
        self.run(BRAKING)
        return max(self.run(seconds)) < STANDING

    def call(self, service: str) -> str:
        """Call a service; return its message."""
        return self._running.ask("service", "call", service, "std_srvs/srv/Trigger").stdout

    def command(self, verb: str, *words: str) -> Program:
        """Run `bot-console stop` or `release` to its end."""
        started = self._running.compose(verb, lambda: sys.exit(run(verb, list(words))), [verb, *words])
        return self._running.finish(started)

    def python(self, text: str, *words: str) -> Program:
        """Run another program."""
        return self._running.python("-c", text, *words)

    def kill(self, name: str) -> None:
        """SIGKILL for a process of the launch."""
        kill_composed(self.launch, name)


@pytest.fixture
def bench() -> Iterator[Bench]:
    """The whole robot system, driving."""
    with system() as running:
        made = Bench(running, "robot_system.launch.py")
        assert made.drives()
        yield made


@pytest.mark.parametrize(
    "topic", ["cmd_vel", *(pytest.param(each, marks=pytest.mark.soak) for each in ("cmd_vel_nav", "cmd_vel_teleop"))]
)
def test_locked_robot_obeys_no_publisher_until_released(bench: Bench, topic: str) -> None:
    bench.python(DRIVER, topic)
    assert bench.drives()
    assert "locked" in bench.call("/safety_monitor/stop")
    assert bench.stands(8.0)
    assert "released" in bench.call("/safety_monitor/release")
    assert bench.drives()


@pytest.mark.slow
def test_killed_monitor_is_restarted_and_robot_stands_until_a_person_releases_it(bench: Bench) -> None:
    bench.python(DRIVER, "cmd_vel")
    bench.kill("safety_node")
    bench.run(0.6)
    assert bench.stands(8.0)
    assert bench.launch.stdout.count("[safety_node") and "the safety monitor has gone" in bench.launch.stdout
    assert len(re.findall(r"safety_node-\d+\]: process started", bench.launch.stdout)) == 2
    bench.call("/simulator/release")
    assert bench.drives()


def test_steering_blocks_the_program_and_silence_locks(bench: Bench) -> None:
    person = bench.python(STEERS)
    assert bench.stands(3.0), "the program may not drive while a person steers"
    person.process.kill()
    assert bench.stands(6.0)
    assert "anna: held the steering and fell silent" in bench.launch.stdout
    assert "still locked by anna" in bench.call("/safety_monitor/release")
    assert bench.stands(), "a plain release must not release another person's stop"
    assert "released" in bench.call("/safety_monitor/release_all")
    assert bench.drives()


@pytest.mark.slow
def test_release_of_a_person_covers_only_their_own_stops(bench: Bench) -> None:
    bench.call("/safety_monitor/stop")
    assert bench.command("stop", "the arm swings").exit == 0
    kept = bench.command("release")
    assert kept.exit == 1 and kept.stderr.startswith("still held by a call of safety_monitor/stop: asked for by a")
    assert bench.stands()
    assert bench.command("stop", "the arm swings").exit == 0
    assert "still locked by bot-console stop of " in bench.call("/simulator/release")
    assert bench.stands()
    assert bench.command("release").exit == 0
    assert bench.drives()
    bench.call("/simulator/stop")
    assert bench.stands()
    assert bench.command("release", "--all").exit == 0
    assert bench.drives()


@pytest.mark.slow
def test_unusable_scans_do_not_end_the_monitor(bench: Bench) -> None:
    blind = bench.python(BLIND)
    bench.run(2.0)
    blind.process.kill()
    bench.run(1.0)
    assert bench.drives()
    assert "process has died" not in bench.launch.stdout


def test_base_without_an_arbiter_locks_itself() -> None:
    with system() as running:
        bench = Bench(running, "single_robot.launch.py")
        assert bench.drives()
        assert "locked" in bench.call("/simulator/stop")
        assert bench.stands()
        bench.call("/reset")
        assert bench.stands(), "a reset releases nothing"
        bench.call("/simulator/release")
        assert bench.drives()


def test_stop_and_release_work_without_a_screen(bench: Bench) -> None:
    bench.python(DRIVER, "cmd_vel")
    stopped = bench.command("stop", "the arm swings")
    assert (stopped.exit, stopped.stdout) == (0, "held: the robot is locked until a person releases it\n")
    assert bench.stands()
    assert ": the arm swings" in bench.launch.stdout
    assert bench.command("release").exit == 0
    assert bench.drives()


@pytest.mark.parametrize("words", [["too", "close"], ["-fire"], ["--all"], ["--", "-h"], ["-1", "m"]])
def test_any_words_are_the_reason_of_a_stop(words: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[str] = []
    monkeypatch.setattr(stop, "ask", lambda verb, reason, **_: (given.append(reason), (True, StopInfo()))[1])
    monkeypatch.setattr(stop, "reach_system", lambda: "")
    monkeypatch.setenv("BOT_CONSOLE_DISTRO", "unknown")
    assert main(["stop", *words]) == 0 and given == [" ".join(words)]


def test_stop_without_acknowledgement_is_reported() -> None:
    with system() as running:
        alone = running.finish(running.compose("stop", lambda: sys.exit(run("stop", [])), ["stop"]))
    assert alone.exit == 1
    assert alone.stderr.startswith("stop sent, not confirmed: no robot with an emergency stop was found")


def slow_lock(late: float, deaf: int) -> None:
    """A robot that is found `late` seconds after the start, and ignores the first `deaf` requests."""
    time.sleep(late)
    rclpy.init()
    node = rclpy.create_node("slow_lock")
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    state = node.create_publisher(DiagnosticStatus, "emergency_stop/base", latched)
    heard: list[DiagnosticStatus] = []

    def report(locked: str) -> None:
        state.publish(DiagnosticStatus(values=[KeyValue(key="locked", value=locked)]))

    def requested(message: DiagnosticStatus) -> None:
        heard.append(message)
        if len(heard) > deaf:
            report("true")

    node.create_subscription(DiagnosticStatus, "emergency_stop/request", requested, 10)
    report("false")
    rclpy.spin(node)


@pytest.mark.parametrize(
    ("late", "deaf", "slow"), [(0.0, 60, 0.0), (8.0, 0, 0.1)], ids=["one that answers late", "on a busy machine"]
)
def test_stop_is_repeated_until_a_slow_robot_acknowledges(
    late: float, deaf: int, slow: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    spin_once = rclpy.spin_once

    def starved(*words: object, **named: object) -> None:
        time.sleep(slow)
        spin_once(*words, **named)

    with system() as running:
        running.compose("slow_lock", lambda: slow_lock(late, deaf), ["slow_lock"])
        monkeypatch.setattr(rclpy, "spin_once", starved)
        asked = running.finish(running.compose("stop", lambda: sys.exit(run("stop", [])), ["stop"]))
    assert (asked.exit, asked.stdout) == (0, "held: the robot is locked until a person releases it\n"), asked.stderr
