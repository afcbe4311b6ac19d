"""The workspace of a run, with the launch files and panes in it."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from bot_console.runtime.programs.installed_entry_points import installed_entry_points, package_of
from bot_console.runtime.workspace.available_names import launch_file_paths
from bot_console.runtime.workspace.builtin_package import FIRST_VARIABLE, NAME, PAGE_NAME, ROOT, is_own
from bot_console.runtime.workspace.demos import is_demo
from bot_console.runtime.workspace.discover import Workspace, default_folders, use, workspace
from bot_console.runtime.workspace.package import Package
from bot_console.runtime.workspace.setup_py import PANES
from bot_console.tui.cli.foreground.once_per_shell import report_once

PROGRAM_LAUNCH = ROOT / "launch" / "program.launch.py"
"""Runs a program that the user has named, which is not one of ours."""
SIMULATOR_LAUNCH = str(ROOT / "launch" / "simulator.launch.py")
"""Starts the simulated robot beside another launch."""
SYSTEM_LAUNCH = str(ROOT / "launch" / "robot_system.launch.py")
"""The launch file that `bot-console` runs by default."""
PANE_GROUP = PANES
"""The entry point group by which packages provide panes."""
SYSTEM_NODES = frozenset(
    (
        "/motion_controller",
        "/robot_navigator",
        "/safety_monitor",
        "/sensor_handler",
        "/simulator",
        "/telemetry_publisher",
    )
)
"""The fully qualified names of the nodes of `SYSTEM_LAUNCH`."""
NAVIGATOR = "/robot_navigator"
"""The node that the launch argument `navigator` replaces or leaves out."""


def choose(folders: Sequence[Path]) -> None:
    """Search for packages in these folders, and in the `src/` of each, instead of in the working directory."""
    if folders:
        use(Workspace([each for folder in folders for each in default_folders(folder)]))


def launch_environment(file: str) -> dict[str, str]:
    """The environment for a launch file. One of our launch files starts our nodes whatever the workspace contains.

    The workspace may contain a package with the same name, such as one that was exported and changed.
    """
    path = Path(file).resolve()
    ours = path.parent == ROOT / "launch" and path != PROGRAM_LAUNCH
    return {**os.environ, FIRST_VARIABLE: "1"} if ours else dict(os.environ)


def report_workspace(package: str) -> None:
    """Print on stderr, once per shell, that a package is the workspace's although one of ours has the same name."""
    here = workspace()
    if package not in (NAME, PAGE_NAME):
        return  # without searching for packages, since the working directory may be large
    found = here.packages.get(package)
    if found is not None and not is_own(found):
        built_in = f"; the bundled robot is '{NAME}'" if package != NAME else ", not the bundled one"
        report_once(f"[INFO] [bot-console]: package '{package}' is the one in {found.folder}{built_in}")


def panes() -> Iterator[tuple[str, Callable[[], Any], str]]:
    """The panes of the workspace's packages: name, a function that imports the pane, and the source."""
    for package in workspace().packages.values():
        for name, point in package.panes.items():
            yield name, _importing(package, point.module, point.function), f"package {package.name}"


def installed_panes() -> Iterator[tuple[str, Callable[[], Any], str]]:
    """The panes of installed packages, in the same form."""
    for point in installed_entry_points(PANE_GROUP):
        yield point.name, point.load, package_of(point)


def _importing(package: Package, module: str, name: str) -> Callable[[], Any]:
    def find() -> Any:
        top = package.modules.get(module.partition(".")[0])
        folder = str(top.parent) if top is not None else str(package.folder)
        if folder not in sys.path:
            sys.path.append(folder)
        return getattr(importlib.import_module(module), name)

    return find


def config_folders() -> tuple[Path, ...]:
    """The folders in the workspace's packages that usually contain parameter files."""
    return tuple(each for found in workspace().packages.values() if (each := found.folder / "config").is_dir())


def launch_files() -> tuple[str, ...]:
    """The launch files of all packages in the workspace; those of the user's own packages come first."""
    packages = workspace().packages
    names = sorted(packages, key=lambda name: is_own(packages[name]) or is_demo(packages[name]))
    return tuple(str(path) for name in names for path in launch_file_paths(name))
