"""Makes the ROS import names (`rclpy`, `std_msgs.msg`, `launch` ...) refer to the embedded runtime.

`install()` puts a finder first on `sys.meta_path`. The modules are loaded under their ROS names, so that they print as
`std_msgs.msg._string.String`; `bot_console.runtime.rclpy` is an alias of the same module object.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence
from functools import cache
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import TYPE_CHECKING, Any

from bot_console.runtime.distribution import distribution
from bot_console.runtime.interfaces.interface_finder import InterfaceFinder, interface_folders, spec_on_path
from bot_console.runtime.process.crashes import explain_with
from bot_console.runtime.programs.exit_messages import limit_fault
from bot_console.runtime.programs.missing_packages import explain_missing_package
from bot_console.runtime.rosidl.sources import EXAMPLES, add_source

if TYPE_CHECKING:
    from bot_console.runtime.process.program import Places

# No importlib.abc, importlib.util or pathlib here, as they take a fifth of the time to the first message.
RUNTIME = os.path.dirname(os.path.realpath(__file__))
GENERATED = os.path.join(RUNTIME, "rosidl", "generated")
PACKAGES = (
    "ament_index_python",
    "cv_bridge",
    "launch",
    "launch_pytest",
    "launch_ros",
    "launch_testing",
    "launch_testing_ros",
    "launch_xml",
    "launch_yaml",
    "message_filters",
    "nav2_simple_commander",
    "rclpy",
    "ros2cli",
    "rosidl_parser",
    "rosidl_runtime_py",
    "sensor_msgs_py",
    "tf2_geometry_msgs",
    "tf2_py",
    "tf2_ros",
    "tf2_sensor_msgs",
    "tf_transformations",
)
ALIAS = "bot_console.runtime."
OWN_PACKAGE = "bot_console_robot"
"""The ROS package in the folder `nodes/`."""
OWN_PACKAGES = (OWN_PACKAGE, "intelligent_robot")
"""Both names of that package; the second applies if the workspace has no package of that name."""
DEMOS = "bot_console_demos"
"""The import name of `nodes/demos/`, the nodes of the tutorials."""


class RosFinder:
    """A finder for `sys.meta_path`: embedded packages under their ROS names, and aliases in `bot_console.runtime`."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of an embedded package or alias; None for any other name."""
        if path is None:
            return self._find_package(fullname)
        if fullname.startswith(ALIAS) and fullname[len(ALIAS) :].split(".", maxsplit=1)[0] in PACKAGES:
            return _alias(fullname, fullname[len(ALIAS) :])
        top, _, rest = fullname.partition(".")
        if top in OWN_PACKAGES[1:] and getattr(sys.modules.get(top), "__name__", top) == OWN_PACKAGE:
            return _alias(fullname, f"{OWN_PACKAGE}.{rest}")
        return None

    def _find_package(self, name: str) -> ModuleSpec | None:
        if name in PACKAGES:
            return PathFinder.find_spec(name, [RUNTIME])
        if name in OWN_PACKAGES:
            return _own_package(name)
        if name == DEMOS:
            return _package_in(name, os.path.join(os.path.dirname(RUNTIME), "nodes", "demos"))
        if os.path.isdir(os.path.join(GENERATED, name)) and not (name in EXAMPLES and name in interface_folders()):
            return PathFinder.find_spec(name, [GENERATED])
        return None


def _own_package(name: str) -> ModuleSpec | None:
    """Return the spec for one of our names: the package of that name in a workspace or on the path, or our nodes."""
    from bot_console.runtime.workspace.discover import workspace

    theirs = workspace().packages.get(name)
    folder = None if theirs is None else theirs.modules.get(name)
    if folder is None and name != OWN_PACKAGE:
        beside = spec_on_path(name)
        return beside if beside is not None and beside.loader is not None else _alias(name, OWN_PACKAGE)
    place = os.path.join(os.path.dirname(RUNTIME), "nodes") if folder is None else os.fspath(folder)
    return _package_in(name, place)


def _package_in(name: str, folder: str) -> ModuleSpec | None:
    from importlib.util import spec_from_file_location

    return spec_from_file_location(name, os.path.join(folder, "__init__.py"), submodule_search_locations=[folder])


def _alias(name: str, stands_for: str) -> ModuleSpec:
    loader: Any = _AliasLoader(stands_for)
    return ModuleSpec(name, loader)


class _AliasLoader:
    """Loads a module by returning the one that is known under another name."""

    def __init__(self, name: str) -> None:
        self.stands_for = name

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = importlib.import_module(self.stands_for)
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self._spec


def is_embedded(name: str) -> bool:
    """Whether a top-level import name belongs to the embedded runtime."""
    return name in PACKAGES or os.path.isdir(os.path.join(GENERATED, name))


@cache
def generated_packages() -> tuple[str, ...]:
    """Return the included packages that have interfaces."""
    with os.scandir(GENERATED) as listed:
        return tuple(each.name for each in listed if each.is_dir())


def places_of(folders: Sequence[str | os.PathLike[str]] = (), *, ours_first: bool = False) -> Places:
    """Return where a program's modules are: in these folders, whose packages precede ours of the same name.

    Each folder corresponds to an entry of `sys.path`: the folder of a node's file, or one that contains a Python
    package. With `ours_first`, our package of nodes precedes one with its name in the folders, for the executables of
    our launches.
    """
    from bot_console.runtime.process.program import Places

    theirs = {*OWN_PACKAGES, DEMOS} - ({OWN_PACKAGE} if ours_first else set[str]())
    return Places([os.fspath(folder) for folder in folders], frozenset(theirs))


_finder = RosFinder()
_interfaces = InterfaceFinder()


def install() -> None:
    """Make the ROS names refer to the embedded runtime; a second call does nothing."""
    if is_installed():
        return
    os.environ.setdefault("ROS_DISTRO", distribution().name)  # as in a shell in which ROS 2 was sourced
    sys.meta_path.insert(0, _finder)
    # Just before the finder for the path, which would take a folder `my_interfaces` without `__init__.py` for a
    # namespace package.
    place = sys.meta_path.index(PathFinder) if PathFinder in sys.meta_path else len(sys.meta_path)
    sys.meta_path.insert(place, _interfaces)
    add_source(interface_folders)
    explain_with(explain_missing_package)
    explain_with(limit_fault)


def is_installed() -> bool:
    """Whether the ROS names refer to the embedded runtime in this process."""
    return _finder in sys.meta_path


def uninstall() -> None:
    """Remove the finders; modules already imported stay."""
    for finder in (_finder, _interfaces):
        if finder in sys.meta_path:
            sys.meta_path.remove(finder)
