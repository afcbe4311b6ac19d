"""What the project asks for, shown by the robot that comes along: its nodes, limits and profiles."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml
from course.page import Page, logs
from course.rows import Row
from course.table import row
from systems import Program

NODES = {
    "robot_navigator": "robot_node",
    "sensor_handler": "sensor_node",
    "safety_monitor": "safety_node",
    "telemetry_publisher": "telemetry_node",
    "motion_controller": "controller_node",
    "simulator": "simulator_node",
}
NAVIGATOR = "/robot_navigator"
FIXED = ("start_type_description_service", "use_sim_time")
AT_START = {"enable_stamped_cmd_vel": "True", "model": "turtlebot4"}
"""Read only, with another value than the default: what a robot is, the command line of its start says."""


def start(page: Page, name: str, *words: str) -> Program:
    """Start the node of that name; it runs on."""
    program = page.start(" ".join(["ros2 run intelligent_robot", NODES[name], *words]))
    assert program.exit is None, program.stderr
    return program


def profile(page: Page, name: str) -> tuple[Path, dict[str, Any]]:
    """A profile's file under the page's name for it, and its values."""
    share = page.ask("ros2 pkg prefix --share intelligent_robot").stdout.strip()
    file = Path(share, "config", f"{name}_config.yaml")
    return file, yaml.safe_load(file.read_text("utf-8"))


def navigator(page: Page, name: str) -> dict[str, Any]:
    return profile(page, name)[1]["robot_navigator"]["ros__parameters"]


@row(289, 290, 291, 292, 293, 294, own=True)
def the_robot_has_the_parameter(page: Page, row: Row) -> None:
    name, kind, limits = re.match(r"(\w+) \((\w+)\): [^(]*(?:\(([^)]*)\))?", row.text).groups()  # type: ignore[union-attr]
    start(page, "robot_navigator")
    described = page.ask(f"ros2 param describe {NAVIGATOR} {name}").stdout
    assert f"  Type: {({'int': 'integer', 'bool': 'boolean'}).get(kind, kind)}\n" in described
    assert "  Description: " in described
    low, high = re.findall(r"[\d.]+", limits) if limits else ("", "")
    assert (f"    Min value: {low}\n    Max value: {high}\n" in described) == bool(limits)


@row(313, 329, own=True)
def each_parameter_has_a_description(page: Page, row: Row) -> None:
    for name in NODES:
        program = start(page, name)
        names = [each for each in page.ask(f"ros2 param list /{name}").stdout.split() if each not in FIXED]
        described = page.ask(f"ros2 param describe /{name} {' '.join(names)}").stdout
        assert described.count("  Description: ") == len(names), described
        page.stop(program)


@row(300, 303, 314, 330, 345, own=True)
def wrong_values_are_refused_with_the_reason(page: Page, row: Row) -> None:
    start(page, "robot_navigator")
    for name, value in (("max_speed", "10.0"), ("turn_rate", "0.05"), ("robot_name", "''"), ("max_speed", "fast")):
        before = page.value(NAVIGATOR, name)
        assert re.match(r"Setting parameter failed: \w+", page.ask(f"ros2 param set {NAVIGATOR} {name} {value}").stderr)
        assert page.value(NAVIGATOR, name) == before


@row(301, 331, 344, own=True)
def a_change_takes_effect_at_once(page: Page, row: Row) -> None:
    started = start(page, "robot_navigator")
    page.ask(f"ros2 param set {NAVIGATOR} robot_name Ada")
    page.run(2.0)
    assert "Ada" in logs(started)[-1].message


@row(302, 332, own=True)
def each_change_is_logged_with_its_time(page: Page, row: Row) -> None:
    started = start(page, "robot_navigator")
    for name, value in (("max_speed", "2.5"), ("safety_distance", "0.8"), ("turn_rate", "2.0")):
        count = len(logs(started))
        page.ask(f"ros2 param set {NAVIGATOR} {name} {value}")
        assert any(value in each.message for each in logs(started)[count:])


@row(312, 315, 316, own=True)
def the_robot_answers_a_scan(page: Page, row: Row) -> None:
    start(page, "robot_navigator")
    info = page.ask(f"ros2 node info {NAVIGATOR}").stdout
    subscribers, _, publishers = info.partition("Publishers:")
    assert "sensor_msgs/msg/LaserScan" in subscribers
    assert "geometry_msgs/msg/Twist" in publishers


def faster(page: Page, one: str, other: str) -> bool:
    return navigator(page, one)["max_speed"] > navigator(page, other)["max_speed"]


@row(265, 305, own=True)
def outdoors_is_faster_and_wider(page: Page, row: Row) -> None:
    assert faster(page, "outdoor", "indoor")
    assert faster(page, "competition", "outdoor")
    assert navigator(page, "outdoor")["safety_distance"] > navigator(page, "indoor")["safety_distance"]


@row(266, 306, own=True)
def the_warehouse_lies_between(page: Page, row: Row) -> None:
    assert faster(page, "warehouse", "indoor")
    assert faster(page, "competition", "warehouse")


@row(267, 307, own=True)
def competition_is_fastest_with_least_distance(page: Page, row: Row) -> None:
    others = ("indoor", "outdoor", "warehouse")
    assert all(faster(page, "competition", each) for each in others)
    distance = navigator(page, "competition")["safety_distance"]
    assert all(distance < navigator(page, each)["safety_distance"] for each in others)


@row(304, own=True)
def indoors_is_slowest(page: Page, row: Row) -> None:
    assert all(faster(page, each, "indoor") for each in ("outdoor", "warehouse", "competition"))
    assert navigator(page, "indoor")["enable_safety"] is True


@row(317, 318, 319, 320, own=True)
def the_profile_loads(page: Page, row: Row) -> None:
    name = re.search(r"(\w+)_config.yaml", row.text)
    assert name is not None
    profile_loads(page, name[1])


@row(343, own=True)
def each_profile_loads(page: Page, row: Row) -> None:
    for name in ("indoor", "outdoor", "warehouse", "competition"):
        profile_loads(page, name)


def profile_loads(page: Page, name: str) -> None:
    file, sections = profile(page, name)
    for node, section in sections.items():
        program = start(page, node, "--ros-args", "--params-file", str(file))
        dumped = yaml.safe_load(page.ask(f"ros2 param dump /{node}").stdout)[f"/{node}"]["ros__parameters"]
        expected = dict(flat(section["ros__parameters"]))
        assert {key: value for key, value in flat(dumped) if key in expected} == expected
        page.stop(program)


def flat(tree: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


@row(342, own=True)
def each_parameter_can_be_set(page: Page, row: Row) -> None:
    for name in NODES:
        program = start(page, name)
        dumped = yaml.safe_load(page.ask(f"ros2 param dump /{name}").stdout)[f"/{name}"]["ros__parameters"]
        for key, value in flat(dumped):
            if key not in (*FIXED, *AT_START):
                text = yaml.safe_dump(value, default_flow_style=True).splitlines()[0]
                answer = page.ask(f'ros2 param set /{name} {key} "{text}"')
                assert answer.stdout == "Set parameter successful\n", (key, answer.stderr)
        page.stop(program)
        if at_start := {key: value for key, value in AT_START.items() if key in dumped}:
            words = [word for key, value in at_start.items() for word in ("-p", f"{key}:={value}")]
            again = start(page, name, "--ros-args", *words)
            assert {key: page.value(f"/{name}", key) for key in at_start} == at_start
            page.stop(again)


@row(83, 260, 270, 363, 369)
def nothing_has_to_be_built(page: Page, row: Row) -> None:
    """The packages of the workspace are there without it."""
    words = row.command.rpartition("&& ")[2].split()
    assert words[:2] == ["colcon", "build"]
    built = page.bot_console(*words)
    assert (built.exit, built.stdout.startswith("Nothing has to be built")) == (0, True)
    assert "my_package" in page.ask("ros2 pkg list").stdout.split()
