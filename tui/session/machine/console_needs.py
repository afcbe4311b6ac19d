"""The packages that the console needs besides the machine's `rclpy`, which comes with few message packages."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Iterable, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType

from bot_console.tui.session.machine.machine_ros import RUNTIME

MESSAGES = ("diagnostic_msgs", "geometry_msgs", "nav_msgs", "rcl_interfaces", "sensor_msgs")
BUNDLED_PACKAGE = ("rosidl_runtime_py", "ros2cli", "launch", "launch_ros", "launch_xml", "launch_yaml")
"""Pure Python packages that work on top of the machine's `rclpy` and `rosidl_parser`; PyPI has no releases of them."""


class BundledPackageFinder:
    """A finder for the end of `sys.meta_path` that provides our copies of packages that the machine lacks."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The spec of a bundled package; None for any other name."""
        if fullname not in BUNDLED_PACKAGE:
            return None
        folder = RUNTIME / fullname
        return importlib.util.spec_from_file_location(
            fullname, folder / "__init__.py", submodule_search_locations=[str(folder)]
        )


def provide_missing() -> None:
    """Make the bundled packages importable where they are not installed; the machine's own take precedence."""
    if not any(isinstance(each, BundledPackageFinder) for each in sys.meta_path):
        sys.meta_path.append(BundledPackageFinder())


def provide_prefixes() -> Sequence[Path]:
    """The prefixes of the machine's packages, also for `ament_index_python`: wheels are in that of their environment,
    which only a sourced ROS 2 would name.
    """
    if not os.environ.get("AMENT_PREFIX_PATH"):
        os.environ["AMENT_PREFIX_PATH"] = sys.prefix
    return [Path(each) for each in os.environ["AMENT_PREFIX_PATH"].split(os.pathsep) if each]


def missing_messages(path: Iterable[str] | None = None) -> str:
    """A line that names the message packages that the console lacks; empty if none is missing."""
    where = None if path is None else list(path)
    missing = [each for each in MESSAGES if PathFinder.find_spec(each, where) is None]
    if not missing:
        return ""
    distro = os.environ.get("ROS_DISTRO", "") or "<distro>"
    packages = " ".join(f"ros-{distro}-{each.replace('_', '-')}" for each in missing)
    return (
        f"this ROS 2 lacks {', '.join(missing)}, which the console needs: install the packages {packages}, or, if they "
        "are built from source, source the workspace that contains them"
    )
