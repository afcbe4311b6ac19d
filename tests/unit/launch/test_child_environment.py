"""Processes that a launch starts by the interpreter or a shell can import `rclpy`, `launch` and messages, and run
`ros2`."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from sampling import slow_after

if os.name != "posix":
    pytest.skip("needs a shell", allow_module_level=True)

from bot_console.runtime.children.child_discovery import let_children_meet
from bot_console.runtime.children.child_environment import child_environment
from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains
from bot_console.runtime.shim_folder import shim_folder
from bot_console.runtime.workspace import discover
from bot_console.runtime.workspace.discover import Workspace, default_folders
from launch.actions import ExecuteProcess
from launch_ros.actions import Node
from launching import Launch

PROGRAM = """
from child_shapes.msg import Corner
from std_msgs.msg import String
import launch.actions, rclpy, sys

rclpy.init()
node = rclpy.create_node("child")
node.create_publisher(String, "text", 1).publish(String(data="x"))
print(Corner(x=1.0), rclpy.__name__, launch.__file__.endswith("runtime/launch/__init__.py"), sys.argv[1:])
"""
PROBE = "import importlib.util; print('has' if importlib.util.find_spec('zenoh') else 'bare')"
OUTPUT = "child_shapes.msg.Corner(x=1.0) rclpy True ['a']"


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    package = tmp_path / "src" / "child_shapes"
    (package / "msg").mkdir(parents=True)
    (package / "msg" / "Corner.msg").write_text("float64 x\n")
    (package / "package.xml").write_text("<package format='3'><name>child_shapes</name></package>")
    monkeypatch.setattr(discover, "_current", [Workspace(default_folders(tmp_path))])
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "node.py"
    path.write_text(PROGRAM)
    return str(path)


@pytest.mark.parametrize(
    ("kind", "python"),
    slow_after(1, [("process", "python3"), ("process", sys.executable), ("node", "python3"), ("shell", "python3")]),
)
def test_program_started_by_its_interpreter_finds_ros(run: Launch, program: str, python: str, kind: str) -> None:
    action: Any = {
        "process": lambda: ExecuteProcess(cmd=[python, program, "a"], output="screen"),
        "node": lambda: Node(executable=shutil.which(python), arguments=[program, "a"], output="screen"),
        "shell": lambda: ExecuteProcess(cmd=[f"true && {python} {program} a"], shell=True, output="screen"),
    }[kind]()
    text = run([action]).text
    assert OUTPUT.removesuffix("]") in text, text


def test_interpreter_without_installed_packages_joins_the_domain(run: Launch, program: str) -> None:
    share_domains()
    let_children_meet(True)
    python = os.path.realpath(sys.executable)
    text = run([ExecuteProcess(cmd=[python, "-I", "-c", PROBE], output="screen")]).text
    if "bare" not in text:
        pytest.skip("the interpreter of this environment has its own zenoh")
    assert OUTPUT.removesuffix("]") in run([ExecuteProcess(cmd=[python, program, "a"], output="screen")]).text


def test_ros2_works_in_a_shell_command(run: Launch, program: str) -> None:
    line = "true; ros2 interface show child_shapes/msg/Corner | tr x y"
    assert "float64 y" in run([ExecuteProcess(cmd=[line], shell=True, output="screen")]).text


def test_launch_and_action_environments_stay_unchanged(run: Launch, program: str) -> None:
    before = [os.environ.get(name) for name in ("PATH", "PYTHONPATH")]
    process = ExecuteProcess(cmd=["env"], output="screen", env={"PATH": "/bin:/usr/bin", "OWN": "1"})
    text = run([process]).text
    assert "OWN=1" in text and "HOME=" not in text
    assert dict(process.env or {}) == {"PATH": "/bin:/usr/bin", "OWN": "1"}
    assert [os.environ.get(name) for name in ("PATH", "PYTHONPATH")] == before


def test_environment_is_extended_only_once(program: str) -> None:
    once = child_environment({"PATH": "/bin", "PYTHONPATH": "/mine"})
    assert child_environment({"OWN": "1"}) == {"OWN": "1"}
    assert child_environment(once) == once and once["PYTHONPATH"].endswith("/mine")


def test_shims_come_before_a_real_rclpy_that_was_sourced(program: str) -> None:
    shims = str(shim_folder())
    path = child_environment({"PATH": "/bin", "PYTHONPATH": f"/ros:{shims}"})["PYTHONPATH"].split(":")
    assert path[0] == shims and path.count(shims) == 1 and path[-1] == "/ros"


def test_program_without_the_environment_finds_no_ros(program: str) -> None:
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([sys.executable, program], env=environment, capture_output=True, text=True, check=False)
    assert "No module named" in done.stderr
