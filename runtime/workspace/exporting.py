"""Exports the robot's package in the layout that colcon expects, for a machine with ROS 2."""

from __future__ import annotations

import ast
import os
import shutil
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from bot_console.runtime.workspace.builtin_package import NAME, ROOT, SECOND_SPELLING, own_package
from bot_console.runtime.workspace.export_readme import readme

ROS_PYTHON = {"numpy": "python3-numpy", "yaml": "python3-yaml"}
"""The rosdep keys of libraries; pymunk has none and comes from pip."""
FROM_PIP = ("pymunk",)
FOLDERS = {
    "launch": ("launch", "*.launch.*"),
    "config": ("profiles", "*.yaml"),
    "worlds": ("profiles/worlds", "*.yaml"),
}


def export(folder: Path) -> Path:
    """Write `<folder>/bot_console_robot`; raises `ValueError` if it exists, and `OSError`."""
    place = Path(os.path.expanduser(folder)).resolve() / NAME
    if place.exists():
        raise ValueError(f"{place} exists; give another folder, or remove it")
    shutil.copytree(ROOT / "nodes", place / NAME, ignore=shutil.ignore_patterns("__pycache__", "*.pyc", "demos"))
    for target, (source, pattern) in FOLDERS.items():
        (place / target).mkdir()
        for path in sorted((ROOT / source).glob(pattern)):
            shutil.copy(path, place / target / (f"{path.stem}_config.yaml" if target == "config" else path.name))
    shutil.copy(ROOT / "launch" / "environment.launch.py", place / "launch" / SECOND_SPELLING)
    (place / "README.md").write_text(readme(NAME, place, own_package().executables), encoding="utf-8")
    (place / "resource").mkdir()
    (place / "resource" / NAME).touch()
    (place / "package.xml").write_text(package_xml(place), encoding="utf-8")
    (place / "setup.py").write_text(setup_py(), encoding="utf-8")
    (place / "setup.cfg").write_text(
        f"[develop]\nscript_dir=$base/lib/{NAME}\n[install]\ninstall_scripts=$base/lib/{NAME}\n", encoding="utf-8"
    )
    return place


def imported(folder: Path) -> set[str]:
    """Return the top-level names that the Python files in a folder import."""
    return {name for path in sorted(folder.rglob("*.py")) for name in _imports(path)}


def _imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_bytes(), str(path))):
        if isinstance(node, ast.Import):
            yield from (each.name.partition(".")[0] for each in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition(".")[0]


def package_xml(place: Path) -> str:
    """Return the manifest, with dependencies on the packages that the files import."""
    names = sorted(imported(place) - set(sys.stdlib_module_names) - {NAME, "setuptools", *FROM_PIP})
    depends = "\n".join(f"  <exec_depend>{ROS_PYTHON.get(each, each)}</exec_depend>" for each in names)
    return f"""<?xml version="1.0"?>
<package format="3">
  <name>{NAME}</name>
  <version>0.1.0</version>
  <description>Nodes of a small robot system, and a simulated robot to run them on (pip install pymunk)</description>
  <maintainer email="robot@example.com">the makers of bot-console</maintainer>
  <license>Apache-2.0</license>
{depends}
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""


def setup_py() -> str:
    """Return the `setup.py`, with one executable for each node."""
    nodes = own_package().executables.items()
    scripts = _lines((f'"{name} = {entry.module}:{entry.function}",' for name, entry in nodes), depth=3)
    data = _lines(f'("share/" + NAME + "/{each}", glob("{each}/*")),' for each in FOLDERS)
    return f"""from glob import glob

from setuptools import find_packages, setup

NAME = "{NAME}"

setup(
    name=NAME,
    version="0.1.0",
    packages=find_packages(),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + NAME]),
        ("share/" + NAME, ["package.xml"]),
{data}
    ],
    install_requires=["setuptools", "pymunk>=7"],
    zip_safe=True,
    entry_points={{
        "console_scripts": [
{scripts}
        ],
    }},
)
"""


def _lines(texts: Iterable[str], depth: int = 2) -> str:
    return "\n".join("    " * depth + each for each in texts)
