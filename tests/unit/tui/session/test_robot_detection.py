"""What counts as a running robot: nodes that publish scans or obey velocities, but not consoles."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.rmw.zenoh.domain import sockets
from bot_console.tui.cli.verbs import background
from bot_console.tui.session.embedded import domain
from domains import unused_domain
from geometry_msgs.msg import Twist
from rclpy.context import Context
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


@pytest.fixture
def make_node(monkeypatch):
    """Makes nodes in a domain in which there seems to be another process."""
    number = unused_domain()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
    monkeypatch.setattr(domain, "others_take_part", lambda: True)
    context = Context()
    context.init([], domain_id=number)
    nodes = []

    def make(name):
        nodes.append(Node(name, context=context))
        return nodes[-1]

    yield make
    for each in nodes:
        each.destroy_node()
    context.try_shutdown()


def test_console_that_watches_velocities_is_not_a_robot(make_node):
    make_node("_bot_console_drive").create_subscription(Twist, "/cmd_vel", lambda message: None, 10)
    make_node("talker")
    assert domain.running_robot_nodes() == []


def test_scan_publisher_and_velocity_subscriber_are_a_robot(make_node):
    make_node("lidar").create_publisher(LaserScan, "/scan", 10)
    make_node("base").create_subscription(Twist, "/cmd_vel", lambda message: None, 10)
    assert domain.running_robot_nodes() == ["/base", "/lidar"]


def test_nodes_with_our_names_are_found_whatever_their_topics(make_node):
    make_node("robot_navigator"), make_node("sensor_handler"), make_node("chatter"), make_node("_safety_monitor")
    assert domain.nodes_there() == ["/chatter", "/robot_navigator", "/sensor_handler"]
    assert domain.same_names_there({}) == ["/robot_navigator", "/sensor_handler"]
    assert domain.same_names_there({"navigator": "mine.py"}) == ["/sensor_handler"]


def test_names_are_those_of_our_launch_file():
    from bot_console.tui.session.embedded.workspaces import SYSTEM_LAUNCH, SYSTEM_NODES

    names = re.findall(r'(?:robot_node\("\w+", |name=)"(\w+)"', Path(SYSTEM_LAUNCH).read_text())
    only_with_goals = {"bt_navigator"}
    assert {f"/{each}" for each in {*names, "robot_navigator", "simulator"} - only_with_goals} == SYSTEM_NODES


@pytest.mark.parametrize(("typed", "attached"), [("", True), ("n", False)])
def test_console_asks_before_it_adds_a_second_node_of_one_name(monkeypatch, capsys, typed, attached):
    from bot_console.tui.cli import attach_question

    asked = []
    monkeypatch.setattr("builtins.input", lambda question: asked.append(question) or typed)
    assert attach_question.wants_to_attach(["/robot_navigator"], robot=False) is attached
    reported = capsys.readouterr().out
    assert "Nodes with our robot's node names run in ROS domain" in reported and "/robot_navigator" in reported
    assert "bot-console --launch bot_console_robot simulator.launch.py" in reported
    assert "`bot-console navigator:=false` starts our robot" in reported, "it needs neither of the other two"
    assert max(map(len, reported.splitlines())) < 80
    assert asked == ["Attach the console to them, without a robot? [Y/n] "]


@pytest.mark.skipif(sys.platform != "linux", reason="reads the states of processes from /proc")
def test_status_reports_a_stopped_process(monkeypatch, capsys):
    with subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"]) as child:
        there = [sockets.Socket("/a", os.getpid(), "0" * 8), sockets.Socket("/b", child.pid, "1" * 8)]
        monkeypatch.setattr(sockets, "sockets", lambda folder: there)
        monkeypatch.setattr(background, "take_part", lambda: "")
        monkeypatch.setattr(background, "running_robot_nodes", lambda: [])
        monkeypatch.setattr(background, "others_take_part", lambda: False)
        monkeypatch.setattr(background, "_running_system", lambda: None)
        try:
            assert background.status([]) == 1
            child.send_signal(signal.SIGSTOP)
            os.waitpid(child.pid, os.WUNTRACED)
            assert background.status([]) == 0
        finally:
            child.kill()
    (reported,) = capsys.readouterr().out.splitlines()
    assert reported.startswith(f"process {child.pid} is stopped: ") and f"kill -CONT {child.pid}" in reported
