"""What the bundled robot does with scans, and with parameters that change while it runs."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import Any, NamedTuple

import yaml
from course.checks_own_robot import FIXED, NAVIGATOR, NODES, flatten, start
from course.page import Page, logs
from course.rows import Row
from course.table import row
from systems import Program

PROBE = """import rclpy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan
rclpy.init()
node = rclpy.create_node('probe')
answers = []
node.create_subscription(Twist, 'cmd_vel', answers.append, 10)
scans = node.create_publisher(LaserScan, 'scan', 10)
rclpy.spin_once(node, timeout_sec=0.1)
for distance in {distances}:
    answers.clear()
    scans.publish(LaserScan(ranges=[distance], intensities=[{intensity}]))
    while not answers:
        rclpy.spin_once(node)
    print(answers[0].linear.x, answers[0].angular.z)
node.destroy_node()
rclpy.shutdown()"""
FREE, NEAR = 8.0, 0.2
"""Distances (m) ahead that count, whatever the settings, as open space and as an obstacle."""


class Answer(NamedTuple):
    """A velocity command: m/s and rad/s."""

    linear: float
    angular: float


def answers(page: Page, *distances: float, intensity: float = 255.0) -> list[Answer]:
    """The navigator's commands for scans whose only beam points ahead and measures these distances (m)."""
    probe = page.python(PROBE.format(distances=list(distances), intensity=intensity), 1.0)
    assert probe.exit == 0, f"it answers {len(probe.stdout.splitlines())} of {len(distances)} scans: {probe.stderr}"
    return [Answer(*map(float, line.split())) for line in probe.stdout.splitlines()]


def answer(page: Page, distance: float, intensity: float = 255.0) -> Answer:
    return answers(page, distance, intensity=intensity)[0]


def set_parameter(page: Page, name: str, value: str) -> None:
    assert page.ask(f"ros2 param set {NAVIGATOR} {name} {value}").stdout == "Set parameter successful\n"
    assert page.value(NAVIGATOR, name) == value


def count_introductions(program: Program) -> int:
    return sum(each.message.endswith("initialized!") for each in logs(program))


@row(312, own=True)
def check_robot_has_all_features(page: Page, row: Row) -> None:
    """It has six parameters with validation, and commands a velocity for each scan."""
    start(page, "robot_navigator")
    listed = page.ask(f"ros2 param list {NAVIGATOR}").stdout.split()
    six = {"max_speed", "safety_distance", "detection_threshold", "turn_rate", "enable_safety", "robot_name"}
    assert set(listed) - set(FIXED) == six
    assert page.ask(f"ros2 param set {NAVIGATOR} max_speed 10.0").stderr.startswith("Setting parameter failed: ")
    assert [each.linear for each in answers(page, FREE, NEAR)] == [1.0, 0.0]


@row(315, own=True)
def check_scans_are_evaluated_by_the_parameters(page: Page, row: Row) -> None:
    """The distance of an obstacle, and the weakest return that counts, are parameters."""
    start(page, "robot_navigator")
    assert [each.linear > 0.0 for each in answers(page, 0.8, 0.4)] == [True, False]
    set_parameter(page, "safety_distance", "1.0")
    assert answer(page, 0.8).linear == 0.0
    set_parameter(page, "detection_threshold", "200")
    assert [answer(page, NEAR, intensity=each).linear for each in (210.0, 190.0)] == [0.0, 1.0]


@row(316, own=True)
def check_velocities_are_commanded(page: Page, row: Row) -> None:
    """At full speed if the way is free; otherwise it turns on the spot at the full turn rate."""
    start(page, "robot_navigator", "--ros-args", "-p", "max_speed:=0.7", "-p", "turn_rate:=0.6")
    free, near = answers(page, FREE, NEAR)
    assert free.linear == 0.7
    assert (near.linear, abs(near.angular)) == (0.0, 0.6)


@row(301, 331, 344, own=True, alike=True)
def check_each_change_takes_effect_at_once(page: Page, row: Row) -> None:
    """The robot behaves differently at once, without a restart."""
    started = start(page, "robot_navigator")
    assert answer(page, FREE).linear == 1.0
    set_parameter(page, "max_speed", "2.5")
    assert answer(page, FREE).linear == 2.5
    set_parameter(page, "turn_rate", "0.25")
    assert abs(answer(page, NEAR).angular) == 0.25
    set_parameter(page, "safety_distance", "0.15")
    assert answer(page, NEAR).linear > 0.0
    set_parameter(page, "safety_distance", "0.5")
    set_parameter(page, "detection_threshold", "255")
    assert answer(page, NEAR, intensity=254.0).linear > 0.0
    set_parameter(page, "enable_safety", "False")
    assert answer(page, NEAR).linear == 2.5
    set_parameter(page, "robot_name", "Ada")
    page.run(1.1)
    assert logs(started)[-1].message == "[Ada] ⚡ PERFORMANCE | Speed: 2.5 m/s"
    assert (started.exit, count_introductions(started)) == (None, 1)


CHANGES = {
    "max_speed": ("2.5", "Max speed: 2.5 m/s"),
    "safety_distance": ("0.8", "Safety distance: 0.8 m"),
    "detection_threshold": ("42", "Threshold: 42"),
    "turn_rate": ("2.0", "Turn rate: 2.0 rad/s"),
    "enable_safety": ("False", "Safety DISABLED"),
    "robot_name": ("Ada", "Name: Ada"),
}
STAMP = re.compile(r"\[(\d{10}\.\d{9})\] \[robot_navigator\]: (.*)$", re.MULTILINE)


@row(302, 332, own=True, alike=True)
def check_each_change_is_logged_with_its_time(page: Page, row: Row) -> None:
    """Each change is logged once, and not at all if refused; the robot gets a change every 1.5 s."""
    started = start(page, "robot_navigator")
    for name, (value, _) in CHANGES.items():
        set_parameter(page, name, value)
        page.run(1.5)
    assert page.ask(f"ros2 param set {NAVIGATOR} max_speed 9.0").stderr
    lines = [(float(stamp), text) for stamp, text in STAMP.findall(started.stderr)]
    reported = [[stamp for stamp, text in lines if text.endswith(stated)] for _, stated in CHANGES.values()]
    assert [len(each) for each in reported] == [1] * len(CHANGES)
    steps = [later - earlier for (earlier,), (later,) in pairwise(reported)]
    assert all(1.5 <= each < 2.0 for each in steps), steps
    assert not any("9.0" in text for _, text in lines)


AT_START = {"enable_stamped_cmd_vel": "True", "model": "turtlebot4"}
"""Read-only parameters with a value other than the default, as given on the command line at the start."""


@row(342, own=True, slow=True)
def check_each_parameter_can_be_set(page: Page, row: Row) -> None:
    """Each parameter is set to a value that it does not have yet."""
    read_only = {**AT_START, "stop_file": str(page.scratch / "stops.json")}
    for name in NODES:
        program = start(page, name)
        values = dict(flatten(parameters(page, name)))
        changeable = sorted(values.keys() - {*FIXED, *read_only})
        wanted = {key: different_value(page, name, key, values[key]) for key in changeable}
        for key, value in wanted.items():
            text = yaml.safe_dump(value, default_flow_style=True).splitlines()[0]
            output = page.ask(f'ros2 param set /{name} {key} "{text}"')
            assert output.stdout == "Set parameter successful\n", (key, output.stderr)
        assert dict(flatten(parameters(page, name))) == {**values, **wanted}
        page.stop(program)
        if at_start := {key: value for key, value in read_only.items() if key in values}:
            words = [word for key, value in at_start.items() for word in ("-p", f"{key}:={value}")]
            again = start(page, name, "--ros-args", *words)
            assert {key: page.value(f"/{name}", key) for key in at_start} == at_start
            page.stop(again)


def parameters(page: Page, node: str) -> dict[str, Any]:
    """The output of `ros2 param dump` for a node."""
    return yaml.safe_load(page.ask(f"ros2 param dump /{node}").stdout)[f"/{node}"]["ros__parameters"]


def different_value(page: Page, node: str, name: str, value: Any) -> Any:
    """A different valid value of the parameter."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        limits = re.findall(r"(?:Min|Max) value: (\S+)", page.ask(f"ros2 param describe /{node} {name}").stdout)
        low, high = (type(value)(float(each)) for each in limits) if limits else (value + 1, value + 2)
        return low if value != low else high
    return {"world": "outdoor", "origin": "start"}.get(name, "another") if isinstance(value, str) else value
