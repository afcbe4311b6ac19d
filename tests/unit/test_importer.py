"""ROS module names resolve to the embedded runtime; a user's packages that have our names take precedence."""

from __future__ import annotations

import importlib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.importer import OWN_PACKAGE, OWN_PACKAGES, is_embedded
from bot_console.runtime.workspace import discover
from bot_console.runtime.workspace.builtin_package import FIRST_VARIABLE, NAME, PAGE_NAME
from sampling import slow_after


def test_ros_modules_are_embedded():
    assert is_embedded("rclpy")
    assert is_embedded("launch_ros")
    assert not is_embedded("numpy")
    assert not is_embedded(OWN_PACKAGE)


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


RUN = """
import sys
from bot_console.runtime.importer import install, places_of
from bot_console.runtime.process import code_program
from bot_console.runtime.workspace import discover

install()
discover.use(discover.Workspace([sys.argv[1]]))
code_program(sys.argv[2], places_of(sys.argv[3:]))()
"""


def runs(workspace: Path, text: str, *folders: Path) -> None:
    """Run a program text in a process that imports modules from these folders."""
    words = [sys.executable, "-c", RUN, *map(str, (workspace, text, *folders))]
    done = subprocess.run(words, capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stderr


def test_own_packages_are_those_of_the_package():
    assert OWN_PACKAGES == (NAME, PAGE_NAME)


def test_our_two_package_names_share_modules(workspace):
    same = (
        "import {0}.simulation_ros.worlds as a, {1}.simulation_ros.worlds as b; "
        "from {0}.simulation import world; assert a.World is world.World"
    )
    runs(workspace, f"{same.format(*OWN_PACKAGES)}; assert a is b")
    runs(workspace, f"{same.format(*reversed(OWN_PACKAGES))}; assert a is b")
    assert importlib.import_module(f"{PAGE_NAME}.detection") is importlib.import_module(f"{OWN_PACKAGE}.detection")
    assert importlib.import_module(f"{OWN_PACKAGE}.detection").__spec__.name == f"{OWN_PACKAGE}.detection"


@pytest.mark.parametrize("name", slow_after(1, OWN_PACKAGES))
def test_workspace_package_with_our_name_takes_precedence(name, workspace):
    make(workspace, name)
    runs(workspace, f"import {name}; assert {name}.theirs")
    runs(workspace, f"import {name}; assert {name}.theirs", workspace / name)


def test_package_beside_the_node_file_takes_precedence(tmp_path):
    (tmp_path / PAGE_NAME).mkdir()
    (tmp_path / PAGE_NAME / "__init__.py").write_text("theirs = True")
    runs(tmp_path, f"import {PAGE_NAME}; assert {PAGE_NAME}.theirs", tmp_path)


def test_folder_of_our_name_beside_a_program_hides_our_package_only_if_it_is_a_package(tmp_path):
    (tmp_path / PAGE_NAME / "worlds").mkdir(parents=True)
    runs(tmp_path, f"import {PAGE_NAME}.trip_computer", tmp_path)


def test_our_name_means_our_package_in_our_own_launch(workspace, monkeypatch):
    make(workspace, OWN_PACKAGE)
    make(workspace, PAGE_NAME)
    monkeypatch.setenv(FIRST_VARIABLE, "1")
    runs(workspace, f"import {OWN_PACKAGE}.trip_computer, {PAGE_NAME}; assert {PAGE_NAME}.theirs", workspace)


def test_embedded_packages_come_first_even_if_the_folder_has_one(tmp_path):
    (tmp_path / "rclpy.py").write_text("")
    runs(tmp_path, "import rclpy; assert rclpy.init", tmp_path)
