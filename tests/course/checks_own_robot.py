"""The requirements of the project, shown by the bundled robot: its nodes, limits and profiles."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml
from course.page import Page
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


def start(page: Page, name: str, *words: str) -> Program:
    """Start the node of that name and leave it running."""
    program = page.start(" ".join(["ros2 run intelligent_robot", NODES[name], *words]))
    assert program.exit is None, program.stderr
    return program


def profile(page: Page, name: str) -> tuple[Path, dict[str, Any]]:
    """A profile's file under the page's name for it, and its values."""
    share = page.ask("ros2 pkg prefix --share intelligent_robot").stdout.strip()
    file = Path(share, "config", f"{name}_config.yaml")
    return file, yaml.safe_load(file.read_text("utf-8"))


@row(289, 290, 291, 292, 293, 294, own=True)
def check_robot_has_the_parameter(page: Page, row: Row) -> None:
    name, kind, limits = re.match(r"(\w+) \((\w+)\): [^(]*(?:\(([^)]*)\))?", row.text).groups()  # type: ignore[union-attr]
    start(page, "robot_navigator")
    described = page.ask(f"ros2 param describe {NAVIGATOR} {name}").stdout
    assert f"  Type: {({'int': 'integer', 'bool': 'boolean'}).get(kind, kind)}\n" in described
    assert "  Description: " in described
    low, high = re.findall(r"[\d.]+", limits) if limits else ("", "")
    assert (f"    Min value: {low}\n    Max value: {high}\n" in described) == bool(limits)


@row(313, 329, own=True, alike=True)
def check_each_parameter_has_a_description(page: Page, row: Row) -> None:
    for name in NODES:
        program = start(page, name)
        names = [each for each in page.ask(f"ros2 param list /{name}").stdout.split() if each not in FIXED]
        described = page.ask(f"ros2 param describe /{name} {' '.join(names)}").stdout
        assert described.count("  Description: ") == len(names), described
        page.stop(program)


@row(300, 303, 314, 330, 345, own=True, alike=True)
def check_wrong_values_are_refused_with_the_reason(page: Page, row: Row) -> None:
    start(page, "robot_navigator")
    for name, value in (("max_speed", "10.0"), ("turn_rate", "0.05"), ("robot_name", "''"), ("max_speed", "fast")):
        before = page.value(NAVIGATOR, name)
        assert re.match(r"Setting parameter failed: \w+", page.ask(f"ros2 param set {NAVIGATOR} {name} {value}").stderr)
        assert page.value(NAVIGATOR, name) == before


@row(317, own=True)
@row(318, 319, 320, own=True, slow=True)
def check_profile_of_the_row_loads(page: Page, row: Row) -> None:
    name = re.search(r"(\w+)_config.yaml", row.text)
    assert name is not None
    check_profile_loads(page, name[1])


@row(343, own=True, slow=True)
def check_each_profile_loads(page: Page, row: Row) -> None:
    for name in ("indoor", "outdoor", "warehouse", "competition"):
        check_profile_loads(page, name)


_loaded: set[str] = set()
"""The profiles that earlier rows of this run have loaded."""


def check_profile_loads(page: Page, name: str) -> None:
    if name in _loaded:
        return
    file, sections = profile(page, name)
    for node, section in sections.items():
        program = start(page, node, "--ros-args", "--params-file", str(file))
        dumped = yaml.safe_load(page.ask(f"ros2 param dump /{node}").stdout)[f"/{node}"]["ros__parameters"]
        expected = dict(flatten(section["ros__parameters"]))
        assert {key: value for key, value in flatten(dumped) if key in expected} == expected
        page.stop(program)
    _loaded.add(name)


def flatten(tree: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from flatten(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
