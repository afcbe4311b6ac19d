"""Our `ros2` verbs on a foreign rclpy, as typed after `:` where the machine has no `ros2`."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.session.machine.launchers import launcher_of_machine
from bot_console.tui.session.machine.ros2_command_line import MachineCommandLine, printed_by
from domains import unused_domain
from rclpy.serialization import serialize_message
from rigs import is_embedded_rclpy, until
from std_msgs.msg import String

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(300),
    pytest.mark.skipif(is_embedded_rclpy(), reason="needs rclpy on a machine without `ros2`: .ci/on_rclpy"),
]
TIMEOUT_S = 240.0
PEER = """
import rclpy
from rclpy.action import ActionServer
from std_msgs.msg import String
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci

def answer(request, response):
    response.message = "pulled"
    return response

def count(goal):
    goal.publish_feedback(Fibonacci.Feedback())
    goal.succeed()
    result = Fibonacci.Result()
    result.sequence = [goal.request.order]
    return result

rclpy.init()
node = rclpy.create_node("peer", namespace="other")
node.declare_parameter("speed", 1.5)
publisher = node.create_publisher(String, "/chatter", 10)
node.create_timer(0.1, lambda: publisher.publish(String(data="hello")))
node.create_service(Trigger, "/pull", answer)
server = ActionServer(node, Fibonacci, "/fibonacci", count)
print("ready", flush=True)
rclpy.spin(node)
"""


@pytest.fixture(scope="module")
def peer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A node in another process, on a machine whose PATH has no `ros2`."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", str(Path(sys.executable).parent))
        patch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
        with subprocess.Popen([sys.executable, "-c", PEER], stdout=subprocess.PIPE) as process:
            assert process.stdout is not None and process.stdout.readline() == b"ready\n"
            yield
            process.kill()


HEARS = """
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("hears")
node.create_subscription(String, "/from_bag", lambda message: print(message.data, flush=True), 10)
rclpy.spin(node)
"""


def test_bag_is_played_into_the_ros2_of_this_machine(peer: None, tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "bag")
    writer.topic("/from_bag", String, [])
    for second in range(1, 4):
        writer.write("/from_bag", serialize_message(String(data=f"word {second}")), second * 1_000_000_000, 0)
    writer.close()
    line = [sys.executable, "-m", "bot_console.tui", "bag", "play", str(tmp_path / "bag"), "--ros", "--rate", "10"]
    with (tmp_path / "heard").open("w") as heard:
        hears = subprocess.Popen([sys.executable, "-c", HEARS], stdout=heard)
        # In a loop: how long two processes take to find each other depends on the middleware.
        player = subprocess.Popen([*line, "--loop", "--disable-keyboard-controls"])
    try:
        until(lambda: "word " in (tmp_path / "heard").read_text(), "a message of the bag")
    finally:
        for each in (player, hears):
            each.kill()
            each.wait()


@pytest.mark.parametrize(
    ("line", "printed"),
    [
        ("node list", "/other/peer\n"),
        ("ros2 topic list -t", "/chatter [std_msgs/msg/String]\n"),
        ("node info /other/peer", "    /pull: std_srvs/srv/Trigger\n"),
        ("topic info /chatter", "Type: std_msgs/msg/String\nPublisher count: 1\n"),
        ("topic echo --once /chatter", "data: hello\n---\n"),
        ("topic pub --once -w 0 /other std_msgs/msg/String '{data: a}'", "std_msgs.msg.String(data='a')"),
        ("service call /pull std_srvs/srv/Trigger", "std_srvs.srv.Trigger_Response(success=False, message='pulled')"),
        ("action info /fibonacci", "Action servers: 1\n    /other/peer\n"),
        ("action send_goal -f /fibonacci test_msgs/action/Fibonacci '{order: 2}'", "Result:\n    sequence:\n- 2\n"),
        ("param list /other/peer", "  speed\n"),
        ("param get /other/peer speed", "Double value is: 1.5\n"),
        ("param set /other/peer speed 1.5", "Set parameter successful\n"),
        ("param dump /other/peer", "/other/peer:\n  ros__parameters:\n    speed: 1.5\n"),
        ("interface show std_msgs/msg/Float64", "float64 data"),
        ("interface package test_msgs", "test_msgs/action/Fibonacci\n"),
        ("interface show tf2_msgs/msg/TFMessage", "Unknown package 'tf2_msgs'"),
        ("interface show std_msgs/msg/Nope", "Could not find the interface '"),
        ("lifecycle get /other/peer", "Node not found"),
    ],
)
def test_verb_works_without_an_installed_ros2(peer: None, line: str, printed: str) -> None:
    def is_printed() -> bool:
        output = printed_by(line, TIMEOUT_S)
        print(output)
        return printed in output

    # Each process discovers the graph from the start, and on a busy machine it may print before it has found the node.
    until(is_printed, repr(printed))


def test_continuous_lines_print_until_they_are_stopped(peer: None) -> None:
    stream = MachineCommandLine().stream("topic echo /chatter")
    assert stream is not None
    until(lambda: "data: hello" in stream.lines(), "a message")
    stream.stop()
    until(lambda: stream.ended, "the end of the line")


def test_command_that_needs_an_installed_ros2_reports_it(peer: None) -> None:
    assert "node" in MachineCommandLine().commands() and "pkg" not in MachineCommandLine().commands()
    assert "there is no command 'ros2'" in printed_by("pkg list") and "topic" in printed_by("pkg list")


def test_launch_file_with_an_unknown_package_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    file = tmp_path / "arm.launch.xml"
    file.write_text('<launch><node pkg="arm_driver" exec="arm"/></launch>')
    launcher = launcher_of_machine(lambda *line: None, lambda *line: None)
    try:
        answer = launcher.launch(str(file), {}).result(TIMEOUT_S)
    finally:
        launcher.close()
    assert not answer.ok and "package 'arm_driver' not found" in answer.text
