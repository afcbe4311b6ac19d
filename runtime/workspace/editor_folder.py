"""Folders in which an editor finds what programs can import here: packages, and type stubs of all interfaces.

They are in the user's cache folder. The installed version's are made once, a workspace's each time.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path

from bot_console.runtime.files.user_folders import cache_folder
from bot_console.runtime.importer import PACKAGES, RUNTIME
from bot_console.runtime.interfaces.interface_finder import interface_folders
from bot_console.runtime.programs.qt_plugins import QT
from bot_console.runtime.rosidl.names import KINDS
from bot_console.runtime.rosidl.sources import EXAMPLES
from bot_console.runtime.rosidl.stubs import package_stubs
from bot_console.runtime.rosidl.texts import PREFIX, standard_packages

WINDOWS = '''\
"""A package of desktop ROS 2: bot-console cannot run it, since it opens windows. Known here for the editor only."""
from typing import Any

def __getattr__(name: str) -> Any: ...
'''
QT_MODULES = {"python_qt_binding": ("QtCore", "QtGui", "QtWidgets"), "rqt_gui_py": ("plugin",)}
"""The modules of these packages that programs import by name."""


def root() -> Path:
    """Return the folder that contains all of them."""
    return cache_folder() / "editor"


def version_folder(version: str) -> Path:
    """Return the folder with the packages and standard interfaces of this version; it is created if missing."""
    sources = sorted(Path(RUNTIME, "rosidl").glob("*.py"))
    states = [RUNTIME, version, *(f"{each.name} {each.stat().st_mtime_ns}" for each in sources)]
    folder = root() / f"{version}-{_digest(states)}"
    if not folder.is_dir():
        _replace(folder, _fill_with_version)
    return folder


def workspace_folder(workspace: Path) -> Path:
    """Create and return the folder with the interfaces of a workspace, and those that the user has added.

    Raises `DefinitionError` with file and line of a mistake.
    """
    folder = root() / f"workspace-{_digest([str(workspace.resolve())])}"
    _replace(folder, _fill_with_workspace)
    return folder


def _digest(texts: Iterable[str]) -> str:
    return hashlib.sha256("\n".join(texts).encode(errors="surrogateescape")).hexdigest()[:12]


def _replace(folder: Path, fill: Callable[[Path], None]) -> None:
    """Fill a new folder and replace the old one with it, so that an editor never reads an incomplete one."""
    folder.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".new-") as made:
        new, old = Path(made, "new"), Path(made, "old")
        new.mkdir()
        fill(new)
        if folder.exists():
            folder.rename(old)
        new.rename(folder)


def _fill_with_version(folder: Path) -> None:
    for name in PACKAGES:
        _link(Path(RUNTIME, name), folder / name)
    _link(Path(RUNTIME).parent / "nodes", folder / "bot_console_robot")
    package = folder / "bot_console"  # Needed only by imports of the others; the editor need not offer the rest.
    package.mkdir()
    _link(Path(RUNTIME), package / "runtime")
    for name in standard_packages():
        _write_stubs(folder / name, name, PREFIX / "share" / name)
    for name in QT:
        for module in ("__init__", *QT_MODULES.get(name, ())):
            _write(folder / name / f"{module}.pyi", WINDOWS)


def _fill_with_workspace(folder: Path) -> None:
    standard = set(standard_packages()) - EXAMPLES
    for name, place in interface_folders().items():
        if name not in standard:
            _write_stubs(folder / name, name, place)


def _write_stubs(folder: Path, package: str, definitions: Path) -> None:
    paths = [each for kind in KINDS for each in (definitions / kind).glob(f"*.{kind}") if each.is_file()]
    texts = {(each.suffix[1:], each.stem): each.read_text(encoding="utf-8") for each in paths}
    for name, source in package_stubs(package, texts).items():
        _write(folder / name, source)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _link(target: Path, place: Path) -> None:
    try:
        os.symlink(target, place, target_is_directory=True)
    except OSError:  # Not every account on Windows may create links.
        shutil.copytree(target, place, ignore=shutil.ignore_patterns("__pycache__", "*.pyc"))
