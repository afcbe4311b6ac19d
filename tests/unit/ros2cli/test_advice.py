"""Hints beyond the output of `ros2`, shown only to a person at a terminal."""

from __future__ import annotations

import io
import sys

import pytest
from ros2cli import advice

NODE = "node = Node('tuned'); node.declare_parameter('gain', 1.0); node.declare_parameter('name', 'x')"
BASE = """from geometry_msgs.msg import Twist
node = Node("base")
node.create_subscription(Twist, "/cmd_vel", print, 10)"""
OUTPUT = [
    (("describe", "/tuned", "gian"), "/tuned has no parameter gian; did you mean gain?"),
    (("describe", "/tuned", "zzz"), "/tuned has no parameter zzz; ros2 param list /tuned shows those it has"),
    (("get", "tuned", "gian"), "did you mean gain?"),
    (("set", "tuned", "gian", "2.0"), "did you mean gain?"),
    (("set", "tuned", "gain", "2"), "gain is a double, which takes no integer: write 2.0"),
    (("set", "tuned", "gain", "0x2"), "write it with a point"),
    (("set", "tuned", "name", "5"), "name is a string: write '\"5\"', as 5 alone is read as integer"),
    (
        ("dump", "/ns/tuned", "--output-dir", "./config"),
        "prints the parameters: mkdir -p ./config && ros2 param dump /ns/tuned > ./config/ns__tuned.yaml",
    ),
    (("dump", "/ns/tuned", "--output-dir", "/tmp"), "the parameters: ros2 param dump /ns/tuned > /tmp/ns__tuned.yaml"),
]


@pytest.mark.parametrize(("words", "reported"), OUTPUT)
def test_mistake_gets_a_hint_at_a_terminal_only(
    ros, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], reported: str
) -> None:
    ros.node(NODE)
    assert reported not in ros.ask("param", *words).stderr
    monkeypatch.setattr(advice, "is_read", lambda: True)
    asked = ros.ask("param", *words)
    assert asked.stderr.rstrip().endswith(reported)


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("param", "get", "/tunde", "gain"), "no node /tunde runs; did you mean /tuned?"),
        (("param", "list", "/other"), "no node /other runs; there are: /tuned"),
        (("node", "info", "tuned"), "no node tuned runs; did you mean /tuned?"),
    ],
)
def test_mistyped_node_name_gets_a_hint(
    ros, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], reported: str
) -> None:
    ros.node(NODE)
    silent = ros.ask(*words)
    assert reported not in silent.stderr
    monkeypatch.setattr(advice, "is_read", lambda: True)
    asked = ros.ask(*words)
    assert asked.stderr == f"{reported}\n{silent.stderr}"
    assert asked.exit == silent.exit == 1


@pytest.mark.parametrize(
    ("line", "reported"),
    [
        ("topic pub /chat", "the type is missing after /chat; `ros2 topic type /chat` prints it"),
        ("service call /flip", "the type is missing after /flip; `ros2 service type /flip` prints it"),
        ("action send_goal /fib", "the type is missing after /fib; `ros2 action type /fib` prints it"),
        ("topic pub --nonsense", ""),
        ("topic pub /chat std_msgs/String --nonsense", ""),
        ("multicast send", "bot-console has no `ros2 multicast`: it is about DDS, which bot-console does not use"),
    ],
)
def test_incomplete_command_line_gets_a_hint(ros, monkeypatch: pytest.MonkeyPatch, line: str, reported: str) -> None:
    assert advice.usage(line.split()) == reported
    monkeypatch.setattr(advice, "is_read", lambda: True)
    asked = ros.ask(*line.split())
    assert asked.exit == 2 and (asked.stderr.endswith(f"{reported}\n") if reported else "error:" in asked.stderr)


def test_hint_says_if_no_node_runs() -> None:
    assert advice.no_node("/robot", []) == "no node runs in this ROS domain"
    assert advice.no_node("/robot", [f"/{each}" for each in range(99)]) == "no node /robot runs"


@pytest.mark.parametrize(
    ("topic", "kind", "reported"),
    [
        (
            "/cmd_vel",
            "std_msgs/msg/String",
            "/cmd_vel is subscribed to as geometry_msgs/msg/Twist, which does not match",
        ),
        ("/cmd_vl", "geometry_msgs/Twist", "nobody subscribes to /cmd_vl; did you mean /cmd_vel?"),
    ],
)
def test_reason_why_nobody_receives_is_reported_once(
    ros, monkeypatch: pytest.MonkeyPatch, topic: str, kind: str, reported: str
) -> None:
    ros.node(BASE)
    monkeypatch.setattr(advice, "is_read", lambda: True)
    asked = ros.ask("topic", "pub", "--once", "--max-wait-time-secs", "2", topic, kind)
    assert asked.stderr.count(reported) == 1 and asked.exit == 1


def test_launch_files_of_the_package_are_listed(ros, monkeypatch: pytest.MonkeyPatch) -> None:
    words = ("launch", "bot_console_robot", "no.launch.py")
    monkeypatch.setattr(advice, "is_read", lambda: False)
    assert "has:" not in ros.ask(*words).stderr
    monkeypatch.setattr(advice, "is_read", lambda: True)
    asked = ros.ask(*words)
    assert "package 'bot_console_robot' has: " in asked.stderr and "robot_system.launch.py" in asked.stderr
    assert asked.exit == 1


def test_command_that_finds_no_other_program_reports_it(ros, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(advice, "is_read", lambda: True)
    assert ros.ask("node", "list").stderr == ""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    assert "ROS_AUTOMATIC_DISCOVERY_RANGE is OFF" in ros.ask("node", "list").stderr


def test_advice_is_not_composed_without_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    advice.advise(lambda: pytest.fail("composed a message"))
