"""The bundled profiles and launch files, judged by how the robot behaves with them."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import yaml
from course.checks_launch import nodes, start_launch
from course.checks_own_driving import FREE, answers
from course.checks_own_robot import NODES, profile, start
from course.page import Page
from course.rows import Row
from course.table import row
from systems import Program

LAUNCH = "ros2 launch intelligent_robot robot_system.launch.py"
PROFILES = ("indoor", "outdoor", "warehouse", "competition")
STEPS = [round(0.1 + 0.05 * each, 2) for each in range(39)]
"""Distances (m) of an obstacle ahead, from 0.1 to 2."""


class DrivingStyle(NamedTuple):
    """How the robot drives with a profile."""

    speed: float
    """The commanded speed if the way is free (m/s)."""
    distance: float
    """The farthest obstacle that it stops for (m)."""
    driven: float
    """The fastest command (m/s) in the first 2 s in the profile's own world."""


_driving_styles: dict[str, DrivingStyle] = {}


def driving_style(page: Page, name: str) -> DrivingStyle:
    """How the robot drives with a profile's file; measured once for all rows."""
    if name not in _driving_styles:
        program = start(page, "robot_navigator", "--ros-args", "--params-file", str(profile(page, name)[0]))
        free, *near = answers(page, FREE, *STEPS)
        page.stop(program)
        stopped = [distance for distance, each in zip(STEPS, near, strict=True) if each.linear == 0.0]
        launch = start_launch(page, f"{LAUNCH} profile:={name}")
        echo = page.ask("ros2 topic echo /cmd_vel --csv", stop_after=2.0)
        page.stop(launch)
        driven = max(float(line.split(",")[0]) for line in echo.stdout.splitlines())
        _driving_styles[name] = DrivingStyle(free.linear, max(stopped, default=0.0), driven)
    return _driving_styles[name]


def is_faster(page: Page, one: str, other: str) -> bool:
    """Whether one profile is faster than another, in open space and in its own world."""
    quick, slow = driving_style(page, one), driving_style(page, other)
    return quick.speed > slow.speed and quick.driven > slow.driven


@row(265, 305, own=True, alike=True)
def check_outdoor_is_faster_and_keeps_more_distance(page: Page, row: Row) -> None:
    assert is_faster(page, "outdoor", "indoor")
    assert is_faster(page, "competition", "outdoor")
    assert driving_style(page, "outdoor").distance > driving_style(page, "indoor").distance


@row(266, 306, own=True, alike=True)
def check_warehouse_is_between_the_others(page: Page, row: Row) -> None:
    assert is_faster(page, "warehouse", "indoor")
    assert is_faster(page, "competition", "warehouse")
    assert driving_style(page, "competition").distance < driving_style(page, "warehouse").distance
    assert driving_style(page, "warehouse").distance < driving_style(page, "outdoor").distance


@row(267, 307, own=True, alike=True)
def check_competition_is_fastest_with_least_distance(page: Page, row: Row) -> None:
    others = ("indoor", "outdoor", "warehouse")
    assert all(is_faster(page, "competition", each) for each in others)
    assert (
        0.0 < driving_style(page, "competition").distance < min(driving_style(page, each).distance for each in others)
    )


@row(304, own=True)
def check_indoor_is_slowest_and_stops_early(page: Page, row: Row) -> None:
    """It keeps the most distance for its speed."""
    assert all(is_faster(page, each, "indoor") for each in PROFILES[1:])
    caution = {name: driving_style(page, name).distance / driving_style(page, name).speed for name in PROFILES}
    assert max(caution, key=lambda name: caution[name]) == "indoor"


@row(346, own=True)
def check_each_profile_drives_differently(page: Page, row: Row) -> None:
    """In open space, and in its world."""
    styles = [driving_style(page, each) for each in PROFILES]
    assert len({each.speed for each in styles}) == len({each.driven for each in styles}) == len(PROFILES)


CUSTOM: dict[str, dict[str, Any]] = {
    "robot_navigator": {"max_speed": 0.65, "robot_name": "Custom"},
    "sensor_handler": {"update_rate": 4.0},
    "safety_monitor": {"emergency_stop_distance": 0.35, "warning_distance": 0.85},
    "telemetry_publisher": {"publish_rate": 3.0},
    "motion_controller": {"max_acceleration": 0.45},
    "simulator": {"seed": 17},
}
"""Values for each node that no profile has and that are not defaults."""


def write_custom_file(page: Page) -> Path:
    file = page.scratch / "custom.yaml"
    file.write_text(yaml.safe_dump({node: {"ros__parameters": values} for node, values in CUSTOM.items()}), "utf-8")
    return file


def assert_loaded(page: Page, sections: dict[str, dict[str, Any]]) -> None:
    """Every node has these values."""
    message = {
        node: {name: yaml.safe_load(page.value(f"/{node}", name)) for name in each} for node, each in sections.items()
    }
    assert message == sections


def system(page: Page, words: str) -> Program:
    return start_launch(page, f"{LAUNCH} {words}")


@row(299, 335, own=True, alike=True)
def check_all_nodes_load_one_file(page: Page, row: Row) -> None:
    assert set(CUSTOM) == set(NODES)
    system(page, f"config_file:={write_custom_file(page)}")
    assert_loaded(page, CUSTOM)


@row(334, own=True)
def check_each_environment_has_its_configuration(page: Page, row: Row) -> None:
    """Settings and world, selected by the argument of the environment launch file."""
    for environment in ("warehouse", "competition"):
        launch = start_launch(page, f"ros2 launch intelligent_robot environment_launch.py environment:={environment}")
        sections = {node: each["ros__parameters"] for node, each in profile(page, environment)[1].items()}
        picked = ("robot_name", "max_speed", "warning_distance", "world")
        assert_loaded(page, {
            node: {name: values[name] for name in picked if name in values}
            for node, values in sections.items() if node in ("robot_navigator", "safety_monitor", "simulator")
        })  # fmt: skip
        page.stop(launch)


@row(336, own=True)
def check_arguments_change_the_launch(page: Page, row: Row) -> None:
    """Profile, seed, world and navigator; wrong values are refused with the choices."""
    shown = page.ask(f"{LAUNCH} --show-args").stdout
    assert all(f"    '{each}':\n" in shown for each in ("profile", "config_file", "seed", "world", "navigator"))
    launch = system(page, "profile:=outdoor seed:=23 world:=warehouse navigator:=false use_sim_time:=true")
    assert "/robot_navigator" not in nodes(page)
    assert_loaded(page, {
        "simulator": {"seed": 23, "world": "warehouse"},
        "safety_monitor": {"warning_distance": 1.2, "use_sim_time": True},
    })  # fmt: skip
    page.stop(launch)
    refused = page.ask(f"{LAUNCH} profile:=moon")
    assert refused.exit == 1
    assert "indoor" in refused.stdout + refused.stderr
