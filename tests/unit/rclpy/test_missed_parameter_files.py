"""A parameter file that matches no node is reported if its key looks mistyped, and only then."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.process.notices import on_notice

SECTION = "{}:\n  ros__parameters:\n    speed: 2.0\n"


@pytest.fixture
def notices_seen():
    lines: list[str] = []
    forget = on_notice(lambda process, text: lines.append(text))
    yield lines
    forget()


def begin(ros: Any, folder: Path, *keys: str, rules: tuple[str, ...] = ()) -> str:
    """Initialize a context with a file that has these keys and return the file's path."""
    file = folder / "parameters.yaml"
    file.write_text("".join(SECTION.format(key) for key in keys))
    ros.init("--params-file", str(file), "-p", "other:=1", *rules)
    return str(file)


@pytest.mark.parametrize(
    ("key", "space"), [("robto_node", ""), ("/robot", ""), ("robot_node", "/left"), ("camera", ""), ("/left/*", "")]
)
def test_mistyped_or_only_key_is_reported_once(
    key: str, space: str, ros: Any, notices_seen: list[str], tmp_path: Path
) -> None:
    file = begin(ros, tmp_path, key)
    node = ros.node("robot_node", namespace=space)
    assert node.declare_parameter("speed", 1.0).value == 1.0
    ros.node("_robot_nodes_hidden_helper")
    full = f"{space}/robot_node"
    assert notices_seen == [
        f"{file}:1: {full} gets no parameter of this file: its key '{key}' does not mean it; did you mean '{full}'?"
    ]


@pytest.mark.parametrize("keys", [("/**",), ("robot_node", "robto_node"), ("/*",), ("camera", "arm")])
def test_file_that_matches_or_has_many_other_keys_is_not_reported(
    keys: tuple[str, ...], ros: Any, notices_seen: list[str], tmp_path: Path
) -> None:
    begin(ros, tmp_path, *keys)
    ros.node("robot_node")
    assert notices_seen == []


def test_key_of_another_node_of_the_program_is_not_reported(ros: Any, notices_seen: list[str], tmp_path: Path) -> None:
    begin(ros, tmp_path, "camera_left")
    ros.node("camera_left")
    ros.node("camera_right")
    assert notices_seen == []


def test_node_named_by_launch_is_not_reported_here(ros: Any, notices_seen: list[str], tmp_path: Path) -> None:
    begin(ros, tmp_path, "robto_node", rules=("-r", "__node:=robot_node"))
    assert ros.node("minimal").get_name() == "robot_node"
    assert notices_seen == []
