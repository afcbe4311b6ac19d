"""The executables of a package: entry points of source packages, and files in `lib/<package>` of installed ones."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

from bot_console.runtime.workspace.demos import demo_packages, is_demo
from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.package import EntryPoint, Package


class Executable(NamedTuple):
    """A program that can be run: an entry point of a source package, or a file."""

    package: str
    name: str
    entry_point: EntryPoint | None = None
    path: Path | None = None

    def __str__(self) -> str:
        if self.path:
            return str(self.path)
        return f"{self.entry_point.module}:{self.entry_point.function}" if self.entry_point else self.name


def executables(package: str) -> dict[str, Executable]:
    """Return a package's executables by name; raises `ament_index_python.PackageNotFoundError` for an unknown
    package.
    """
    from ament_index_python.resources import get_resources

    source = workspace().find(package)
    if source is not None and (source.name != package or is_demo(source)) and package in get_resources("packages"):
        source = None  # an installed package has our second name, or is the tutorial's
    found = {} if source is None else _of_source(source)
    if source is None or not found:
        found = {**_of_prefix(package, required=source is None), **found}
    if not found and package in demo_packages():
        return _of_source(demo_packages()[package])  # in the workspace it is C++, which is not built here
    return found


def executable_names(package: str) -> dict[str, str]:
    """Return the names of a package's executables with descriptions, for `ros2 pkg executables`."""
    return {name: str(each) for name, each in executables(package).items()}


def _of_source(package: Package) -> dict[str, Executable]:
    found = {name: Executable(package.name, name, entry_point=each) for name, each in package.executables.items()}
    for name, path in package.scripts.items():
        found.setdefault(name, Executable(package.name, name, path=path))
    return found


def _of_prefix(package: str, *, required: bool) -> dict[str, Executable]:
    from ament_index_python.packages import PackageNotFoundError, get_package_prefix

    try:
        folder = Path(get_package_prefix(package)) / "lib" / package
    except PackageNotFoundError:
        if required:
            raise
        return {}
    if not folder.is_dir():
        return {}
    files = (each for each in sorted(folder.iterdir()) if each.is_file() and os.access(each, os.X_OK))
    return {each.name: Executable(package, each.name, path=each) for each in files}
