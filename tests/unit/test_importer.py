"""ROS module names resolve to the embedded runtime; each start of a node imports its own modules again.

Our nodes are composed: they share their modules."""

from __future__ import annotations

import importlib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.importer import OWN_PACKAGE, OWN_PACKAGES, is_embedded, node_modules
from bot_console.runtime.process import NodeProcess, file_program
from bot_console.runtime.workspace import discover
from bot_console.runtime.workspace.builtin_package import FIRST_VARIABLE, NAME, PAGE_NAME


def test_ros_modules_are_embedded():
    assert is_embedded("rclpy")
    assert is_embedded("launch_ros")
    assert not is_embedded("numpy")
    assert not is_embedded(OWN_PACKAGE)


def test_composed_nodes_share_their_modules(tmp_path):
    (tmp_path / "one.py").write_text(f"import {OWN_PACKAGE}.trip as a, sys; sys.exit(id(a) % 251)")
    process = NodeProcess("node")
    process.start(file_program(str(tmp_path / "one.py"), node_modules([tmp_path])))
    assert process.wait(20.0) == id(importlib.import_module(f"{OWN_PACKAGE}.trip")) % 251
    assert not node_modules().owns(OWN_PACKAGE)


@pytest.fixture
def workspace(tmp_path: Path) -> Iterator[Path]:
    """A folder that is the workspace."""
    before = discover.workspace()
    discover.use(discover.Workspace([tmp_path]))
    yield tmp_path
    discover.use(before)


def make(folder: Path, name: str) -> Path:
    package = folder / name / name
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("theirs = True")
    (folder / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    (folder / name / "setup.py").write_text(f"from setuptools import setup\nsetup(name={name!r}, packages=[{name!r}])")
    return package.parent


def run(path: Path, text: str) -> int | None:
    """Run the file as a node process and return its exit code."""
    path.write_text(text)
    process = NodeProcess("node")
    process.start(file_program(str(path), node_modules([path.parent])))
    return process.wait(20.0)


def test_own_packages_are_those_of_the_package():
    assert OWN_PACKAGES == (NAME, PAGE_NAME)


def test_our_two_package_names_share_modules(workspace):
    same = (
        "import {0}.simulator.worlds as a, {1}.simulator.worlds as b; "
        "from {0}.simulation import world; assert a.World is world.World"
    )
    assert run(workspace / "one.py", f"{same.format(*OWN_PACKAGES)}; assert a is b") == 0
    assert run(workspace / "other.py", f"{same.format(*reversed(OWN_PACKAGES))}; assert a is b") == 0
    assert importlib.import_module(f"{PAGE_NAME}.detection") is importlib.import_module(f"{OWN_PACKAGE}.detection")
    assert importlib.import_module(f"{OWN_PACKAGE}.detection").__spec__.name == f"{OWN_PACKAGE}.detection"


@pytest.mark.parametrize("name", OWN_PACKAGES)
def test_workspace_package_with_our_name_takes_precedence(name, workspace):
    make(workspace, name)
    assert node_modules().load(name).theirs
    assert node_modules([workspace / name]).load(name).theirs


def test_package_beside_the_node_file_takes_precedence(tmp_path):
    (tmp_path / PAGE_NAME).mkdir()
    (tmp_path / PAGE_NAME / "__init__.py").write_text("theirs = True")
    assert node_modules([tmp_path]).load(PAGE_NAME).theirs


BESIDE = """
from bot_console.runtime.importer import install, node_modules
from bot_console.runtime.process import code_program

install()
code_program("import {name}.trip", node_modules([{folder!r}]))()
"""


def test_folder_of_our_name_beside_a_program_hides_our_package_only_if_it_is_a_package(tmp_path):
    (tmp_path / PAGE_NAME / "worlds").mkdir(parents=True)
    program = BESIDE.format(name=PAGE_NAME, folder=str(tmp_path))
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr


def test_our_name_means_our_package_in_our_own_launch(workspace, monkeypatch):
    make(workspace, OWN_PACKAGE)
    make(workspace, PAGE_NAME)
    monkeypatch.setenv(FIRST_VARIABLE, "1")
    assert run(workspace / "node.py", f"import {OWN_PACKAGE}.trip, {PAGE_NAME}; assert {PAGE_NAME}.theirs") == 0


def test_embedded_packages_are_shared_even_if_the_folder_has_one(tmp_path):
    (tmp_path / "rclpy.py").write_text("")
    assert not node_modules([tmp_path]).owns("rclpy")
