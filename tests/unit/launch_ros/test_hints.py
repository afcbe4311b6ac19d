"""Mistakes in a launch's arguments and parameters are reported with the line to change, where a person reads."""

from __future__ import annotations

import os
import re
import textwrap
from pathlib import Path
from typing import Any

import pytest

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

from bot_console.runtime.programs.hints import SHOW
from launch.actions import IncludeLaunchDescription
from launching import Launch

PROGRAM = """\
import rclpy
from rclpy.node import Node

rclpy.init()
node = Node("robot")
node.declare_parameter("max_speed", 1.0)
node.declare_parameter("name", "r2")
node.create_timer(0.0, rclpy.shutdown)
rclpy.spin(node)
print(node.get_parameter("max_sped").value)
"""

HANDLED = """\
import sys
import rclpy

rclpy.init()
try:
    rclpy.create_node("robot").declare_parameter("max_speed", 1.0)
except Exception as error:
    print(error)
    sys.exit(1)
"""

LAUNCH = """\
from launch import LaunchDescription
from launch_ros.actions import Node

HERE = {here!r}


def node(**options):
    return Node(executable=HERE + "/program.py", output="screen", **options)


def generate_launch_description():
    return LaunchDescription([
        node(exec_name="integer", parameters=[
            {{"name": "a"}},
            {{
                "max_speed": 2,
            }},
        ]),
        node(exec_name="misspelt", name="robot", parameters=[{{"max_sped": 2.0}}]),
        node(exec_name="file_integer", name="robot", parameters=[HERE + "/integer.yaml"]),
        node(exec_name="file_misspelt", name="robot", parameters=[HERE + "/misspelt.yaml"]),
        node(exec_name="file_unspaced", parameters=[HERE + "/unspaced.yaml"]),
        node(exec_name="file_underscore", parameters=[HERE + "/underscore.yaml"]),
        node(exec_name="file_string", name="robot", parameters=[HERE + "/string.yaml"]),
        node(exec_name="wildcard", name="robot", parameters=[HERE + "/wildcard.yaml"]),
        node(exec_name="by_argument", ros_arguments=["-p", "max_speed:2.0"]),
        Node(executable=HERE + "/handled.py", exec_name="handled", parameters=[HERE + "/integer.yaml"]),
    ])
"""

FILES = {
    "integer": "robot:\n  ros__parameters:\n    name: a\n    max_speed: 2\n",
    "misspelt": "robot:\n  ros__parameters: {max_sped: 2.0}\n",
    "unspaced": "robot:\n  ros__parameters:\n    max_speed:2.0\n    name: a\n",
    "underscore": "robot:\n  ros_parameters:\n    max_speed: 2.0\n",
    "string": "/robot:\n  ros__parameters:\n\n    name: 7\n",
    "wildcard": "/**:\n  ros__parameters:\n    other: 1\n",
}

HINTS = {
    "integer": "{here}/x.launch.py:16: max_speed is a double, which takes no integer: write 2.0",
    "misspelt": "{here}/x.launch.py:19: max_sped: ... sets nothing: /robot declares no parameter max_sped; "
    "did you mean max_speed?",
    "file_integer": "{here}/integer.yaml:4: max_speed is a double, which takes no integer: write 2.0",
    "file_misspelt": "{here}/misspelt.yaml:2: max_sped: ... sets nothing: /robot declares no parameter max_sped; "
    "did you mean max_speed?",
    "file_unspaced": "{here}/unspaced.yaml:3: YAML needs a blank after the colon: write max_speed: 2.0",
    "file_underscore": "{here}/underscore.yaml:2: ros_parameters has one underscore, ros__parameters has two",
    "file_string": "{here}/string.yaml:4: name is a string: write '\"7\"', as 7 alone is read as integer",
    "wildcard": "",
    "handled": "{here}/integer.yaml:4: max_speed is a double, which takes no integer: write 2.0",
    "by_argument": "write -p max_speed:=2.0, with an equals sign",
}
UNDECLARED = "{here}/program.py:10: the parameter max_sped is not declared; did you mean max_speed?"


@pytest.fixture
def reported_hints(run: Launch, tmp_path: Path) -> Any:
    """Run the launch file; return the hints that each process has reported."""
    for name, text in (("program", PROGRAM), ("handled", HANDLED)):
        (tmp_path / f"{name}.py").write_text("#!/usr/bin/env python3\n" + text.replace("\n\nrclpy", "\nrclpy", 1))
        (tmp_path / f"{name}.py").chmod(0o755)
    (tmp_path / "x.launch.py").write_text(textwrap.dedent(LAUNCH.format(here=str(tmp_path))))
    for name, text in FILES.items():
        (tmp_path / f"{name}.yaml").write_text(text)

    def found() -> dict[str, list[str]]:
        include = IncludeLaunchDescription(str(tmp_path / "x.launch.py"))
        lines = run([include]).lines
        hints = [re.fullmatch(r"\[(\w+)-\d+\] \[WARN\] \[\S+\]: (.*)", line) for line in lines]
        by_process: dict[str, list[str]] = {name: [] for name in HINTS}
        for each in hints:
            if each is not None:
                by_process[each[1]].append(each[2])
        return by_process

    return found


def test_processes_of_a_launch_report_mistakes_with_their_lines(
    reported_hints: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(SHOW, "1")
    found = reported_hints()
    for name, hint in HINTS.items():
        expected = [hint.format(here=tmp_path)] if hint else []
        if name in ("misspelt", "file_misspelt", "wildcard"):  # the others end before the program reads anything
            expected.append(UNDECLARED.format(here=tmp_path))
        assert found[name] == expected, name


def test_without_a_reader_processes_print_only_the_messages_of_ros(
    reported_hints: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(SHOW, raising=False)
    assert not any(reported_hints().values())
