"""Finds the packages of a workspace, and provides them to the ament index, the importer and `run`."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

from bot_console.runtime.process.scratch import scratch
from bot_console.runtime.workspace.builtin_package import NAME, PAGE_NAME, is_own, own_is_first, own_package, own_share
from bot_console.runtime.workspace.demos import demo_packages, demo_share, is_demo
from bot_console.runtime.workspace.package import Package, read_package
from bot_console.runtime.workspace.share import share_folder

IGNORED = frozenset({"build", "install", "log", "node_modules", "__pycache__", "venv", "site-packages"})
MARKERS = frozenset({"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"})
MAX_DEPTH = 6
"""How many levels of folders below a workspace are searched for packages."""
SOURCED_VARIABLE = "BOT_CONSOLE_WORKSPACE"
"""The workspaces whose `install/setup.bash` was sourced in a shell, separated by colons; the last sourced is first."""
MAX_FOLDERS = 20_000
"""The maximum number of folders searched, so that a start in a home directory does not take minutes."""


class Workspace:
    """The source packages below some folders, the included one, and those of the tutorials; the first with a name wins.

    The included package comes after those in the folders, but first in our own launches.
    """

    def __init__(self, folders: Sequence[Path]) -> None:
        self.folders = tuple(folders)

    @property
    def packages(self) -> Mapping[str, Package]:
        """The packages by name."""
        return self._with_ours_first if own_is_first() else self._with_ours_last

    def find(self, name: str) -> Package | None:
        """Return the package with this name, or None; ours also has a second name unless another package has it."""
        packages = self.packages
        return packages.get(name) or (packages[NAME] if name == PAGE_NAME else None)

    @cached_property
    def _with_ours_last(self) -> Mapping[str, Package]:
        found: dict[str, Package] = {}
        budget = [MAX_FOLDERS]
        for folder in self.folders:
            for each in _package_folders(os.fspath(folder), MAX_DEPTH, budget):
                package = read_package(Path(each))
                found.setdefault(package.name, package)
        found.setdefault(NAME, own_package())
        return MappingProxyType({**demo_packages(), **found})

    @cached_property
    def _with_ours_first(self) -> Mapping[str, Package]:
        return MappingProxyType({**self._with_ours_last, NAME: own_package()})

    def share(self, name: str) -> Path | None:
        """Return the share folder of a package, or None if it is not in the workspace."""
        package = self.find(name)
        if package is None:
            return None
        key = package.name, package.folder
        if key not in self._shares:
            self._shares[key] = self._new_share(package)
        return self._shares[key]

    def _new_share(self, package: Package) -> Path:
        if is_own(package):
            return own_share(self._links)
        if is_demo(package):
            return demo_share(package, self._links / "demos")
        return share_folder(package, self._links / "workspace")

    @cached_property
    def _shares(self) -> dict[tuple[str, Path], Path]:
        return {}

    @cached_property
    def _links(self) -> Path:
        """Return a folder of this process for share folders made of links; it is deleted with the process."""
        return Path(tempfile.mkdtemp(prefix="share-", dir=scratch()))


def default_folders(start: Path) -> tuple[Path, ...]:
    """Return the folders searched by default: the folder itself, and `src/` below it."""
    return (start, start / "src") if (start / "src").is_dir() else (start,)


def _package_folders(folder: str, depth: int, budget: list[int]) -> Iterator[str]:
    """Yield folders with a `package.xml`, as colcon finds them: not below another package, nor in ignored folders.

    Each folder is read only once, and no `Path` objects are created, as a launch waits for this.
    """
    budget[0] -= 1
    if budget[0] == 0:
        _warn_of_size(folder)
    if budget[0] <= 0:
        return
    try:
        with os.scandir(folder) as listed:
            entries = {each.name: each for each in listed}
    except OSError:
        return
    if any(os.path.exists(entries[marker]) for marker in MARKERS & entries.keys()):
        return
    # the entry's own method raises for some links
    if "package.xml" in entries and os.path.isfile(entries["package.xml"]):
        yield folder
    elif depth:
        below = (name for name, each in entries.items() if each.is_dir(follow_symlinks=False))
        for name in sorted(each for each in below if each not in IGNORED and not each.startswith(".")):
            yield from _package_folders(os.path.join(folder, name), depth - 1, budget)


def _warn_of_size(folder: str) -> None:
    print(
        f"[WARN] [bot-console]: more than {MAX_FOLDERS} folders: the search for packages stopped at {folder}. "
        "Start in the workspace itself, or name it with --workspace",
        file=sys.stderr,
    )


_current: list[Workspace] = []


def workspace() -> Workspace:
    """Return the workspace of this run: the working directory's plus the sourced ones, unless `use` has set another."""
    if not _current:
        here = default_folders(Path.cwd())
        sourced = (Path(each) for each in os.environ.get(SOURCED_VARIABLE, "").split(os.pathsep) if each)
        _current.append(Workspace([*here, *(each for each in sourced if each not in here and each.is_dir())]))
    return _current[0]


def use(chosen: Workspace) -> None:
    """Set the workspace of this run."""
    _current[:] = [chosen]
