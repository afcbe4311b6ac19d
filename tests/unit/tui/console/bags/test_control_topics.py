"""A bag is not played on topics that command a robot or concern its stop, unless they are named."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from bot_console.tui.cli.bags import common
from bot_console.tui.cli.verbs import bag as verb
from bot_console.tui.console.bags.playing import discovery
from bot_console.tui.console.bags.playing.control_topics import controls
from bot_console.tui.console.bags.playing.player import PlaybackOptions, Player
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter
from bot_console_robot.safety.latch import Request
from bot_console_robot.safety.stop_messages import request_message
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseStamped, Twist
from rclpy.serialization import serialize_message
from rosidl_runtime_py.utilities import get_message
from std_msgs.msg import String, UInt32

pytest.importorskip("mcap")
SECOND = 10**9
REQUEST = "/robot2/emergency_stop/request"
STATUS = "diagnostic_msgs/msg/DiagnosticStatus"
TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture
def node() -> Iterator[rclpy.node.Node]:
    rclpy.init()
    made = rclpy.create_node("player")
    yield made
    made.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def recorded_bag(tmp_path: Path) -> Bag:
    """A bag that was recorded with --all while a stop of a namespaced robot was released."""
    writer = BagWriter(tmp_path / "bag")
    messages = {
        REQUEST: request_message(Request("release", "ann", key="console-1")),
        "/robot2/emergency_stop/base": DiagnosticStatus(name="simulator: emergency stop"),
        "/odd_name": Twist(),
        "/goal_pose": PoseStamped(),
        "/telemetry/stops": UInt32(data=3),
        "/words": String(data="a"),
    }
    for at, (topic, message) in enumerate(messages.items(), 1):
        writer.topic(topic, type(message), [])
        writer.write(topic, serialize_message(message), at * SECOND, 0)
    writer.close()
    return Bag(tmp_path / "bag")


def played_topics(node: rclpy.node.Node, bag: Bag, how: PlaybackOptions) -> tuple[set[str], list[str]]:
    """The topics on which a bag was played, and those that were left out."""
    player = Player(node, bag, how, get_message)
    published = {name for name, _ in node.get_publisher_names_and_types_by_node("player", "/")}
    player.run(threading.Event())
    return published - {"/rosout", "/parameter_events"}, sorted(player.left_out)


def test_recorded_commands_and_releases_are_not_played(node: rclpy.node.Node, recorded_bag: Bag) -> None:
    published, left_out = played_topics(node, recorded_bag, PlaybackOptions(rate=1e6))
    assert published == {"/words", "/telemetry/stops"}
    assert left_out == ["/goal_pose", "/odd_name", "/robot2/emergency_stop/base", REQUEST]


def test_named_topics_are_played(node: rclpy.node.Node, recorded_bag: Bag) -> None:
    published, left_out = played_topics(node, recorded_bag, PlaybackOptions(rate=1e6, topics=[REQUEST, "odd_name"]))
    assert (published, left_out) == ({REQUEST, "/odd_name"}, [])


def test_a_topic_remapped_to_a_control_topic_is_left_out(node: rclpy.node.Node, recorded_bag: Bag) -> None:
    remaps = {"/words": "/emergency_stop/request", REQUEST: "/then"}
    published, left_out = played_topics(node, recorded_bag, PlaybackOptions(rate=1e6, remaps=remaps))
    assert published == {"/telemetry/stops"}
    assert "/words" in left_out and REQUEST in left_out


def test_the_warning_reports_what_is_left_out_and_how_to_include_it(
    recorded_bag: Bag, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(common, "reach_system", lambda: "")
    monkeypatch.setattr(discovery, "MIN_S", 0.0)
    try:
        assert verb.run(["play", str(recorded_bag.path), "-r", "1e6"]) == 0
    finally:
        rclpy.try_shutdown()
    out, err = capsys.readouterr()
    (line,) = (each for each in err.splitlines() if each.startswith("warning: "))
    assert all(topic in line for topic in (REQUEST, "/goal_pose", "/odd_name", "--topics")) and "/words" not in line
    assert not out and "2 messages published" in err


@pytest.mark.parametrize(
    ("topic", "type_name"),
    [
        ("/emergency_stop/request", STATUS),
        ("/a/b/emergency_stop/arbiter", STATUS),
        ("/emergency_stop/anything_new", "std_msgs/msg/UInt64"),
        ("/cmd_vel", "my_msgs/msg/Velocity"),
        ("/robot2/cmd_vel_teleop", TWIST),
        ("/elsewhere", "geometry_msgs/msg/TwistStamped"),
        ("/ackermann", "ackermann_msgs/msg/AckermannDriveStamped"),
        ("/arm_controller/joint_trajectory", "trajectory_msgs/msg/JointTrajectory"),
        ("/wheels/commands", "std_msgs/msg/Float64MultiArray"),
        ("/steer", "std_msgs/msg/Float64"),
        ("/joy", "sensor_msgs/msg/Joy"),
        ("/initialpose", "geometry_msgs/msg/PoseWithCovarianceStamped"),
        ("/pause_navigation", "std_msgs/msg/Bool"),
        ("/base/e_stop", "std_msgs/msg/Bool"),
        ("/base/estop2", "std_msgs/msg/Bool"),
        ("/base/EStop", "std_msgs/msg/Bool"),
        ("/emergencystop", "std_msgs/msg/Empty"),
        ("/stopMotors", "std_msgs/msg/Bool"),
        ("/wheels/velocityCommand", "std_msgs/msg/Float64"),
        ("/command3", "std_msgs/msg/Float64"),
        ("/motors/enable", "std_msgs/msg/Bool"),
        ("/safety/unlock", "std_msgs/msg/Empty"),
        ("/kill_switch", "std_msgs/msg/Bool"),
    ],
)
def test_control_topics_are_recognised(topic: str, type_name: str) -> None:
    assert controls(topic, type_name)


@pytest.mark.parametrize(
    ("topic", "type_name"),
    [
        ("/scan", "sensor_msgs/msg/LaserScan"),
        ("/odom", "nav_msgs/msg/Odometry"),
        ("/telemetry/stops", "std_msgs/msg/UInt32"),
        ("/locks/count", "std_msgs/msg/UInt32"),
        ("/bumper", "std_msgs/msg/Bool"),
        ("/tf", "tf2_msgs/msg/TFMessage"),
        ("/rosout", "rcl_interfaces/msg/Log"),
        ("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),
        ("/clock", "rosgraph_msgs/msg/Clock"),
        ("/blocked", "std_msgs/msg/Bool"),
        ("/isBlocked2", "std_msgs/msg/Bool"),
        ("/stop/image", "sensor_msgs/msg/Image"),
        ("/holder", "std_msgs/msg/String"),
    ],
)
def test_other_topics_are_not_control_topics(topic: str, type_name: str) -> None:
    assert not controls(topic, type_name)
