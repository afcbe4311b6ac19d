"""A node launched from source whose package defines messages: nothing is built or installed."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover
from bot_console.runtime.workspace.discover import Workspace, default_folders
from launch_ros.actions import Node
from launching import Launch

FILES = {
    "package.xml": (
        "<package format='3'><name>launched_shapes</name>"
        "<export><build_type>ament_python</build_type></export></package>"
    ),
    "setup.py": (
        "from setuptools import setup\n"
        "setup(name='launched_shapes', packages=['launched_shapes'],\n"
        "      entry_points={'console_scripts': ['drawer = launched_shapes.drawer:main']})\n"
    ),
    "msg/Corner.msg": "float64 x\nfloat64 y 2.5\n",
    "srv/Area.srv": "launched_shapes/Corner[] corners\n---\nfloat64 area\n",
    "launched_shapes/__init__.py": "",
    "launched_shapes/settings.py": "path = 'a path'\nargv = 'words'\nmodules = 4\nstdout = 'a pipe'\n",
    "launched_shapes/drawer.py": """
import rclpy
from launched_shapes import settings
from launched_shapes.msg import Corner
from launched_shapes.srv import Area


def main():
    rclpy.init()
    node = rclpy.create_node("drawer")
    publisher = node.create_publisher(Corner, "corners", 1)
    publisher.publish(Corner(x=1.0))
    print(Corner(x=1.0), Area.Request(corners=[Corner()]).corners[0].y)
    print(settings.path, settings.argv, settings.modules, settings.stdout)
    rclpy.shutdown()
""",
}


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    for name, text in FILES.items():
        path = tmp_path / "src" / "launched_shapes" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.setattr(discover, "_current", [Workspace(default_folders(tmp_path))])
    yield "launched_shapes"
    for name in [each for each in sys.modules if each.startswith("launched_shapes")]:
        del sys.modules[name]


def test_node_imports_interfaces_of_its_package_and_has_its_environment(run: Launch, package: str) -> None:
    text = run([Node(package=package, executable="drawer", output="screen")]).text
    assert "launched_shapes.msg.Corner(x=1.0, y=2.5) 2.5" in text
    assert "a path words 4 a pipe" in text
    assert "process has finished cleanly" in text
