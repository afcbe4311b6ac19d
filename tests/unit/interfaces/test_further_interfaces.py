"""Interface packages beyond the core: which ones are included, how more are added, and what they cost."""

from __future__ import annotations

import importlib
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.files.user_folders import cache_folder
from bot_console.runtime.interfaces import further_interfaces, interface_cache
from bot_console.runtime.rosidl.cdr import deserialize, serialize

LARGE = ("nav2_msgs", "control_msgs", "irobot_create_msgs", "geographic_msgs")
"""The packages with the most definitions."""
PACKAGES = sorted(further_interfaces.unverified_folders())


@pytest.mark.parametrize(
    "package", [pytest.param(each, marks=pytest.mark.slow) if each in LARGE else each for each in PACKAGES]
)
def test_all_definitions_give_classes_that_survive_serialization(package: str) -> None:
    folder = further_interfaces.unverified_folders()[package]
    for path in sorted(folder.rglob("*.*")):
        kind = path.parent.name
        made = getattr(importlib.import_module(f"{package}.{kind}"), path.stem)
        parts = {"msg": (made,), "srv": (), "action": ()}[kind] or (
            (made.Request, made.Response) if kind == "srv" else (made.Goal, made.Result, made.Feedback)
        )
        for part in parts:
            sent = serialize(part())
            assert serialize(deserialize(sent, part)) == sent


def test_included_packages_are_the_expected_ones() -> None:
    assert set(PACKAGES) == {
        "ackermann_msgs",
        "can_msgs",
        "control_msgs",
        "controller_manager_msgs",
        "geographic_msgs",
        "irobot_create_msgs",
        "map_msgs",
        "nav2_msgs",
        "pcl_msgs",
        "rosbag2_interfaces",
        "turtlebot3_msgs",
        "vision_msgs",
    }


def test_packages_cost_nothing_until_imported() -> None:
    text = (
        "import sys; from bot_console.runtime.importer import install; install(); import rclpy, std_msgs.msg;"
        "print([name for name in sys.modules if 'further_interfaces' in name or 'interface_cache' in name])"
    )
    assert subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_second_import_takes_code_from_the_cache() -> None:
    made: list[str] = []

    def source() -> str:
        made.append("x")
        return "answer = 42"

    for definition in ("int32 a", "int32 a", "int32 b"):
        names: dict[str, object] = {}
        exec(interface_cache.compiled_module("cached.msg", definition, source), names)
        assert names["answer"] == 42
    assert len(made) == 2


def test_damaged_cache_is_rebuilt() -> None:
    interface_cache.compiled_module("spoilt.msg", "int32 a", lambda: "answer = 1")
    for path in (cache_folder() / "interfaces").iterdir():
        path.write_bytes(b"nonsense")
    names: dict[str, object] = {}
    exec(interface_cache.compiled_module("spoilt.msg", "int32 a", lambda: "answer = 2"), names)
    assert names["answer"] == 2


def test_unwritable_cache_is_not_an_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path / "file"))
    assert interface_cache.compiled_module("nowhere.msg", "", lambda: "x = 1").co_filename == "<nowhere.msg>"
