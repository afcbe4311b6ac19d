"""The console on a foreign ROS 2, through public interfaces alone: see `helpers/fakes/ros_installation.py`."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from emulator import screen_of
from fakes.ros_installation import make_standin

sys.path.insert(0, str(Path(__file__).parent))
from terminal import TIMEOUT_S, Terminal

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

CONSOLE = ["-m", "bot_console.tui"]
ROBOT = """
import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("{name}")
node.declare_parameter("top_speed", 1.25)
node.create_subscription(Twist, "/cmd_vel", lambda message: node.get_logger().info("driven"), 10)
try:
    node.get_logger().warning("{name} is up")
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""
CROWD = """
import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from std_msgs.msg import String

rclpy.init()
executor = SingleThreadedExecutor()
nodes = [rclpy.create_node(f"part_{number:02}") for number in range(50)]
for number, node in enumerate(nodes):
    node.declare_parameter("share", number / 50)
    for side in ("left", "right"):
        node.create_publisher(String, f"/wire_{number:02}_{side}", 10)
    executor.add_node(node)
try:
    executor.spin()
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""
LAUNCH = """
import sys
from launch import LaunchDescription
from launch.actions import ExecuteProcess

def generate_launch_description():
    shown = ExecuteProcess(cmd=["sh", "-c", "echo guard ${{_ROS_WHEELS_BOOTSTRAP_COMPLETE-none}}"], output="screen")
    launched = ExecuteProcess(cmd=[sys.executable, {program!r}], name="launched", output="screen")
    return LaunchDescription([launched, shown])
"""


@pytest.fixture(scope="module")
def sourced(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment in which the stand-in is sourced."""
    return make_standin(tmp_path_factory.mktemp("opt"))


@pytest.fixture
def program() -> str:
    """The text of the robot's program."""
    return ROBOT.format(name="rover")


@pytest.fixture
def robot(
    sourced: dict[str, str], program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[subprocess.Popen[bytes]]:
    """A robot of that ROS 2, in a separate process."""
    for name in ("PYTHONPATH", "ROS_DISTRO", "RMW_IMPLEMENTATION"):
        monkeypatch.setenv(name, sourced[name])
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    process = subprocess.Popen([sys.executable, "-c", program])
    yield process
    process.kill()
    process.wait()


@pytest.mark.slow
def test_attached_console_shows_the_robot_launches_programs_and_leaves_the_robot_running(
    robot: subprocess.Popen[bytes], tmp_path: Path
) -> None:
    program, file = tmp_path / "second.py", tmp_path / "second.launch.py"
    program.write_text(ROBOT.format(name="second"))
    file.write_text(LAUNCH.format(program=str(program)))
    with Terminal([*CONSOLE, "attach", "--ros"], tmp_path) as terminal:
        terminal.read_until(lambda: b"top_speed" in terminal.output, "the robot")
        terminal.type("2")  # A smaller terminal shows one pane at a time.
        terminal.read_until(lambda: b"rover is up" in terminal.output, "its line in the log")
        shows = screen_of(terminal)
        terminal.read_until(lambda: shows("ROS 2 standin", "range LOCALHOST, this"), "the range and the distribution")
        terminal.type("8o")
        terminal.read_until(lambda: b"Open a launch file" in terminal.output, "the question for a file")
        terminal.type(f"{file}\r")
        terminal.read_until(lambda: shows("launched-1"), "the launched process")
        terminal.type("2")
        terminal.read_until(lambda: b"second is up" in terminal.output, "its line in the log")
        assert b"guard none" in terminal.output
        terminal.type("q")
        assert terminal.wait() == 0
        assert terminal.is_usable()
        assert robot.poll() is None


@pytest.mark.soak
@pytest.mark.parametrize("program", [pytest.param(CROWD, id="crowd")])
def test_robot_of_fifty_nodes_and_a_hundred_topics_is_shown(robot: subprocess.Popen[bytes], tmp_path: Path) -> None:
    with Terminal([*CONSOLE, "attach", "--ros"], tmp_path) as terminal:
        shows = screen_of(terminal)
        terminal.read_until(lambda: shows("part_00", "part_05"), "its first nodes")
        terminal.type("1/part_49\r")
        terminal.read_until(lambda: shows("part_49", "0.98"), "the last node's parameter")
        terminal.type("9/wire_49_right\r")
        terminal.read_until(lambda: shows("/wire_49_right", "1 of 1"), "the last topic, of more than a hundred")
        terminal.type("q")
        assert terminal.wait() == 0


@pytest.mark.slow
def test_console_asks_which_system_to_attach_to_if_an_embedded_one_runs_too(
    robot: subprocess.Popen[bytes], tmp_path: Path
) -> None:
    line = [sys.executable, *CONSOLE, "attach"]
    seen = ""
    for _ in range(100):  # Until the robot has a socket in the domain.
        done = subprocess.run(line, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
        seen = done.stderr
        if done.returncode == 2:
            break
    assert "--ros or --embedded" in seen and "ROS 2 standin" in seen
