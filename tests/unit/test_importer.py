"""The ROS names mean the embedded runtime; a start of a node imports its own modules anew."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.importer import OWN_PACKAGE, OWN_PACKAGES, is_embedded, node_modules
from bot_console.runtime.process import NodeProcess, file_program
from bot_console.runtime.workspace import discover
from bot_console.runtime.workspace.builtin_package import FIRST_VARIABLE, NAME, PAGE_NAME


def test_embedded_names():
    assert is_embedded("rclpy")
    assert is_embedded("launch_ros")
    assert not is_embedded("numpy")
    assert not is_embedded(OWN_PACKAGE)


def test_own_nodes_are_imported_again_for_each_start():
    shared = importlib.import_module(OWN_PACKAGE)
    first, second = node_modules().load(OWN_PACKAGE), node_modules().load(OWN_PACKAGE)
    assert first is not second
    assert shared is not first
    assert first.__file__ == shared.__file__


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
    """The exit code of a node process that runs this file."""
    path.write_text(text)
    process = NodeProcess("node")
    process.start(file_program(str(path), node_modules([path.parent])))
    return process.wait(20.0)


def test_the_names_are_those_of_the_package():
    assert OWN_PACKAGES == (NAME, PAGE_NAME)


def test_our_two_names_are_the_same_modules(workspace):
    same = (
        "import {0}.simulator.worlds as a, {1}.simulator.worlds as b; "
        "from {0}.simulation import world; assert a.World is world.World"
    )
    assert run(workspace / "one.py", f"{same.format(*OWN_PACKAGES)}; assert a is b") == 0
    assert run(workspace / "other.py", f"{same.format(*reversed(OWN_PACKAGES))}; assert a is b") == 0
    assert importlib.import_module(f"{PAGE_NAME}.detection") is importlib.import_module(f"{OWN_PACKAGE}.detection")
    assert importlib.import_module(f"{OWN_PACKAGE}.detection").__spec__.name == f"{OWN_PACKAGE}.detection"


@pytest.mark.parametrize("name", OWN_PACKAGES)
def test_a_workspace_package_of_our_name_wins(name, workspace):
    make(workspace, name)
    assert node_modules().load(name).theirs
    assert node_modules([workspace / name]).load(name).theirs


def test_what_lies_beside_a_node_file_wins(tmp_path):
    (tmp_path / PAGE_NAME).mkdir()
    (tmp_path / PAGE_NAME / "__init__.py").write_text("theirs = True")
    assert node_modules([tmp_path]).load(PAGE_NAME).theirs


def test_in_a_launch_of_our_own_our_name_means_ours(workspace, monkeypatch):
    make(workspace, OWN_PACKAGE)
    make(workspace, PAGE_NAME)
    monkeypatch.setenv(FIRST_VARIABLE, "1")
    assert run(workspace / "node.py", f"import {OWN_PACKAGE}.trip, {PAGE_NAME}; assert {PAGE_NAME}.theirs") == 0


def test_embedded_packages_are_shared_whatever_lies_in_the_folder(tmp_path):
    (tmp_path / "rclpy.py").write_text("")
    assert not node_modules([tmp_path]).owns("rclpy")
