"""Makes the ROS import names (`rclpy`, `std_msgs.msg`, `launch` ...) mean the embedded runtime.

`install()` puts one finder first on `sys.meta_path`. The modules load under their ROS names, so that texts show
`std_msgs.msg._string.String`; `bot_console.runtime.rclpy` is an alias of the same module object.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import TYPE_CHECKING, Any

from bot_console.runtime.interface_finder import InterfaceFinder, interface_folders
from bot_console.runtime.missing_packages import explain_missing_package
from bot_console.runtime.process.crashes import explain_with
from bot_console.runtime.rosidl.sources import EXAMPLES, add_source

if TYPE_CHECKING:
    from bot_console.runtime.process.fresh_import import FreshModules

# No importlib.abc, importlib.util or pathlib here: they are a fifth of the time to the first message.
RUNTIME = os.path.dirname(os.path.realpath(__file__))
GENERATED = os.path.join(RUNTIME, "rosidl", "generated")
PACKAGES = (
    "ament_index_python",
    "launch",
    "launch_ros",
    "launch_xml",
    "launch_yaml",
    "rclpy",
    "ros2cli",
    "rosidl_parser",
    "rosidl_runtime_py",
)
ALIAS = "bot_console.runtime."
OWN_PACKAGE = "intelligent_robot"
"""The ROS package that the folder `nodes/` is."""


class RosFinder:
    """A finder of `sys.meta_path`: embedded ROS packages by their ROS names, and aliases in `bot_console.runtime`."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The spec of an embedded package or alias; None for every other name."""
        if path is None:
            return self._find_package(fullname)
        if fullname.startswith(ALIAS) and fullname[len(ALIAS) :].split(".", maxsplit=1)[0] in PACKAGES:
            loader: Any = _AliasLoader(fullname[len(ALIAS) :])
            return ModuleSpec(fullname, loader)
        return None

    def _find_package(self, name: str) -> ModuleSpec | None:
        if name in PACKAGES:
            return PathFinder.find_spec(name, [RUNTIME])
        if name == OWN_PACKAGE:
            return _own_package()
        if os.path.isdir(os.path.join(GENERATED, name)) and not (name in EXAMPLES and name in interface_folders()):
            return PathFinder.find_spec(name, [GENERATED])
        return None


def _own_package() -> ModuleSpec | None:
    """`intelligent_robot` where the workspace has a package of that name, else our own nodes."""
    from importlib.util import spec_from_file_location

    from bot_console.runtime.workspace.discover import workspace

    theirs = workspace().packages[OWN_PACKAGE].modules.get(OWN_PACKAGE)
    folder = os.path.join(os.path.dirname(RUNTIME), "nodes") if theirs is None else os.fspath(theirs)
    init = os.path.join(folder, "__init__.py")
    return spec_from_file_location(OWN_PACKAGE, init, submodule_search_locations=[folder])


class _AliasLoader:
    """Loads a module by giving the one that stands under its ROS name."""

    def __init__(self, name: str) -> None:
        self._name = name

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = importlib.import_module(self._name)
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self._spec


def is_embedded(name: str) -> bool:
    """Whether a top-level import name means a part of the embedded runtime."""
    return name in PACKAGES or os.path.isdir(os.path.join(GENERATED, name))


def node_modules(folders: Sequence[str | os.PathLike[str]] = ()) -> FreshModules:
    """Modules for one start of a node: what lies in `folders`, and our own nodes, anew; the embedded runtime is shared.

    A folder is what would be on `sys.path`: that of a node file, or the one in which a Python package lies.
    """
    from bot_console.runtime.process.fresh_import import FreshModules

    return FreshModules([os.fspath(folder) for folder in folders], packages=[OWN_PACKAGE], shared=is_embedded)


_finder = RosFinder()
_interfaces = InterfaceFinder()


def install() -> None:
    """Make the ROS names mean the embedded runtime; a second call does nothing."""
    if _finder in sys.meta_path:
        return
    os.environ.setdefault("ROS_DISTRO", "jazzy")  # as in a shell that has sourced ROS 2
    sys.meta_path.insert(0, _finder)
    # Just before the path: a folder `my_interfaces` without `__init__.py` would be a namespace package there.
    place = sys.meta_path.index(PathFinder) if PathFinder in sys.meta_path else len(sys.meta_path)
    sys.meta_path.insert(place, _interfaces)
    add_source(interface_folders)
    explain_with(explain_missing_package)


def uninstall() -> None:
    """Take the finders away again; modules already imported stay."""
    for finder in (_finder, _interfaces):
        if finder in sys.meta_path:
            sys.meta_path.remove(finder)
