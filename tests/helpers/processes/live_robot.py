"""A live robot in separate processes, and a witness process that uses the ground truth to see whether it moves."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from polling import until

MOVING, RESTING = 0.1, 0.02
"""Speeds (m/s or rad/s) above which the robot counts as driving, and below which odometry counts as at rest."""
TIMEOUT_S = 240.0
"""Seconds after which a rig gives up; the tests measure no time with it."""

WITNESS = """
import time
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile

rclpy.init()
node = rclpy.create_node("witness")

def moved(message):
    twist = message.twist.twist
    print("speed", time.monotonic(), max(abs(twist.linear.x), abs(twist.angular.z)), flush=True)

def requested(message):
    values = {each.key: each.value for each in message.values}
    if values.get("request") == "release":
        print("release", values.get("ids", "").replace(" ", ""), flush=True)

def reported(message):
    values = {each.key: each.value for each in message.values}
    print("lock", message.hardware_id, values.get("instance"), flush=True)

node.create_subscription(Odometry, "ground_truth", moved, 10)
node.create_subscription(DiagnosticStatus, "emergency_stop/request", requested, 100)
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
for each in ("arbiter", "base"):
    node.create_subscription(DiagnosticStatus, "emergency_stop/" + each, reported, latched)
rclpy.spin(node)
"""
"""Prints the robot's speed, the releases that are requested, and which start of each lock reports."""

DRIVER = """
import sys
import rclpy
from geometry_msgs.msg import Twist

rclpy.init()
node = rclpy.create_node("second_driver")
publisher = node.create_publisher(Twist, sys.argv[1], 10)
command = Twist()
command.linear.x, command.angular.z = map(float, sys.argv[2:] or (0.5, 0.8))
node.create_timer(0.01, lambda: publisher.publish(command))
rclpy.spin(node)
"""

BLIND = """
import math
import rclpy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

rclpy.init()
node = rclpy.create_node("blind")
scans = node.create_publisher(LaserScan, "scan", 10)
twists = node.create_publisher(Twist, "cmd_vel_teleop", 10)
scan = LaserScan(angle_increment=math.nan, ranges=[math.nan] * 9)
twist = Twist()
twist.linear.x = math.nan
node.create_timer(0.01, lambda: (scans.publish(scan), twists.publish(twist)))
rclpy.spin(node)
"""

SYSTEM = """
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node

CONFIG = get_package_share_directory("bot_console_robot") + "/config/indoor_config.yaml"


def node(executable, name, remappings=()):
    return Node(package="bot_console_robot", executable=executable, name=name, parameters=[CONFIG],
                remappings=list(remappings))


def generate_launch_description():
    return LaunchDescription([
        node("controller_node", "motion_controller", [("cmd_vel", "cmd_vel_nav")]),
        node("robot_node", "robot_navigator", [("cmd_vel", "cmd_vel_desired")]),
    ])
"""


class LiveRobot:
    """A base, a safety monitor, other nodes and the witness, each in a separate process."""

    attach: Sequence[str] = ("-m", "bot_console.tui", "attach")
    """The arguments of Python for a console on this robot."""
    circle: Sequence[str] = ()
    """The velocities (m/s, rad/s) of a second program that drives the robot, if not the usual ones."""

    def __init__(self, folder: Path, environment: Mapping[str, str]) -> None:
        self.folder = folder
        self.environment = {**os.environ, **environment}
        self._seen: list[tuple[float, float]] = []
        self.releases: list[str] = []
        """The ids in each release that the witness has seen, as JSON."""
        self.instances: dict[str, list[str]] = {}
        """By lock, its starts that the witness has seen."""
        self._started: list[subprocess.Popen[bytes]] = []
        self._log = (folder / "robot.log").open("ab")
        self.start()
        witness = self.program(WITNESS, stdout=subprocess.PIPE)
        threading.Thread(target=self._read, args=(witness,), daemon=True).start()

    def start(self) -> None:
        """Start everything but the witness."""
        path = self.folder / "system.launch.py"
        path.write_text(SYSTEM)
        self.console("--headless", "--duration", "1e9", "--launch", str(path), "--no-simulator")
        self.base = self.start_base()
        self.monitor = self.start_monitor()

    def _read(self, witness: subprocess.Popen[bytes]) -> None:
        assert witness.stdout is not None
        for line in witness.stdout:
            match line.decode().split():
                case ["speed", moment, speed]:
                    self._seen.append((float(moment), float(speed)))
                case ["release", ids]:
                    self.releases.append(ids)
                case ["lock", name, instance]:
                    known = self.instances.setdefault(name, [])
                    if instance not in known:
                        known.append(instance)
                case _:
                    pass  # the runtime's own lines

    def console(
        self, *words: str | bytes, stdout: int | None = None, environment: Mapping[str, str] | None = None
    ) -> subprocess.Popen[bytes]:
        """Start a command line of the program."""
        line = [sys.executable, "-m", "bot_console.tui", *words]
        process = subprocess.Popen(
            line, cwd=self.folder, env={**self.environment, **(environment or {})}, stdin=subprocess.DEVNULL,
            stdout=self._log if stdout is None else stdout, stderr=self._log, start_new_session=True,
        )  # fmt: skip
        self._started.append(process)
        return process

    def program(self, text: str, *words: str, stdout: int | None = None) -> subprocess.Popen[bytes]:
        """Start a node as a separate program."""
        file = self.folder / f"program{len(self._started)}.py"
        file.write_text(text)
        return self.console("run", str(file), *words, stdout=stdout)

    def second_driver(self) -> subprocess.Popen[bytes]:
        """Start a program that publishes on the base's own topic, a hundred times a second."""
        return self.program(DRIVER, "cmd_vel", *self.circle)

    def start_base(self) -> subprocess.Popen[bytes]:
        """Start the simulator, at the start of its world."""
        self.base = self.console("run", "bot_console_robot", "simulator_node", "--ros-args", "-p", "seed:=1")
        return self.base

    def start_monitor(self) -> subprocess.Popen[bytes]:
        """Start the safety monitor."""
        self.monitor = self.console("run", "bot_console_robot", "safety_node")
        return self.monitor

    def run_cli(self, *words: str | bytes, environment: Mapping[str, str] | None = None) -> int:
        """Run a command line to its end; returns its exit code."""
        return self.console(*words, environment=environment).wait(TIMEOUT_S)

    def answer(self, *words: str) -> str:
        """Run a command line to its end; returns what it prints."""
        return self.console(*words, stdout=subprocess.PIPE).communicate(timeout=TIMEOUT_S)[0].decode()

    def speeds(self, since: float, until: float = float("inf")) -> list[tuple[float, float]]:
        """The speeds that the witness has seen between two times of `time.monotonic`."""
        return [each for each in list(self._seen) if since <= each[0] <= until]

    def until(self, true: Callable[[], bool], what: str) -> None:
        """Wait for a condition."""
        until(true, lambda: f"no {what}: {self.log()[-3000:]}", poll_s=0.02)

    def drives(self) -> None:
        """Wait until the robot drives."""
        began = time.monotonic()
        self.until(lambda: any(speed > MOVING for _, speed in self.speeds(began)), "driving robot")

    def rests(self, since: float, within: float, watched: float) -> float:
        """Return how long (s) after `since` the robot came to rest; raise if it moves later than `within`, or is not
        seen.

        It is watched for `watched` seconds after that.
        """
        end = since + within + watched
        self.until(lambda: any(moment >= end for moment, _ in self.speeds(since)), "odometry")
        moving = [moment - since for moment, speed in self.speeds(since, end) if speed > RESTING]
        last = max(moving, default=0.0)
        assert last <= within, f"it moves {last:.2f} s after it was to stand"
        return last

    def log(self) -> str:
        """Everything that its processes have printed."""
        return (self.folder / "robot.log").read_text(errors="replace")

    def close(self) -> None:
        """End all processes."""
        for each in self._started:
            with contextlib.suppress(ProcessLookupError):
                each.kill()
        for each in self._started:
            each.wait()
        self._log.close()


class BackgroundRobot(LiveRobot):
    """The robot that `bot-console up` starts, with both locks in one process."""

    def start(self) -> None:
        """Start it."""
        assert self.run_cli("up", "indoor") == 0, self.log()

    def close(self) -> None:
        """End the robot and all other processes."""
        self.run_cli("down")
        super().close()


@contextlib.contextmanager
def live_robot(folder: Path, sockets: Path, domain: int = 77, kind: type[LiveRobot] = LiveRobot) -> Iterator[LiveRobot]:
    """A driving robot in a separate domain; `sockets` must be a short path."""
    sockets.mkdir(mode=0o700, exist_ok=True)
    robot = kind(
        folder, {"BOT_CONSOLE_SOCKET_DIR": str(sockets), "ROS_DOMAIN_ID": str(domain), "ROS_HOME": str(folder),
                 "BOT_CONSOLE_USER_DIR": "", "XDG_STATE_HOME": str(folder), "XDG_CONFIG_HOME": str(folder),
                 "OMP_NUM_THREADS": "1"},
    )  # fmt: skip
    try:
        robot.drives()
        yield robot
    finally:
        robot.close()
