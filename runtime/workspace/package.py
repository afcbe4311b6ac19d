"""A source package: what its `package.xml`, `setup.py`, `setup.cfg` and `CMakeLists.txt` install."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from bot_console.runtime.rosidl.names import KINDS
from bot_console.runtime.workspace.cmake_lists import read_cmake_lists
from bot_console.runtime.workspace.setup_py import PANES, SetupFile, entry_lines, read_setup_py

MAX_NAME_CHARACTERS = 100
"""How many characters of a file's name are shown in a problem."""


class EntryPoint(NamedTuple):
    """A console script that calls `function` of `module`."""

    module: str
    function: str


@dataclass(frozen=True)
class Package:
    """A package. `problem` says why it cannot be used as it is; empty if it can."""

    name: str
    folder: Path
    build_type: str = ""
    version: str = ""
    executables: Mapping[str, EntryPoint] = field(default_factory=lambda: MappingProxyType({}))
    scripts: Mapping[str, Path] = field(default_factory=lambda: MappingProxyType({}))
    modules: Mapping[str, Path] = field(default_factory=lambda: MappingProxyType({}))
    """The Python packages by import name."""
    data_files: tuple[tuple[str, tuple[Path, ...]], ...] = ()
    problem: str = ""
    panes: Mapping[str, EntryPoint] = field(default_factory=lambda: MappingProxyType({}))
    """The panes that it provides for the console."""
    setup: SetupFile | None = None
    """The contents of its setup files; None if there are none."""

    @cached_property
    def has_interfaces(self) -> bool:
        """Whether the package defines messages, services or actions."""
        return any(next((self.folder / each).glob(f"*.{each}"), None) for each in KINDS)


def read_package(folder: Path) -> Package:
    """Read the package in a folder that holds a `package.xml`."""
    from xml.etree import ElementTree  # imported here, as launches without packages do not need it

    try:
        root = ElementTree.parse(folder / "package.xml").getroot()
    except (ElementTree.ParseError, OSError) as error:
        return Package(folder.name, folder, problem=f"{folder / 'package.xml'}: {error}")
    name = (root.findtext("name") or folder.name).strip()
    build_type = (root.findtext("export/build_type") or "ament_cmake").strip()
    setup, problem = SetupFile(), ""
    try:
        setup = read_setup_py(folder) if _is_there(folder / "setup.py") else setup
        setup = setup.merged(read_setup_cfg(folder)) if _is_there(folder / "setup.cfg") else setup
        if build_type == "ament_cmake" and _is_there(folder / "CMakeLists.txt"):
            setup = setup.merged(read_cmake_lists(folder))
        problem = setup.problem
    except ValueError as error:
        problem = str(error)
    except OSError as error:  # one of these files contains a name that no file can have
        problem = f"{folder}: {error.strerror}: {str(error.filename)[:MAX_NAME_CHARACTERS]}"
    return Package(
        name,
        folder,
        build_type,
        (root.findtext("version") or "").strip(),
        MappingProxyType({key: _entry_point(text) for key, text in setup.console_scripts.items()}),
        MappingProxyType(setup.scripts),
        MappingProxyType(setup.modules),
        setup.data_files,
        problem,
        MappingProxyType({key: _entry_point(text) for key, text in setup.panes.items()}),
        setup,
    )


def _is_there(path: Path) -> bool:
    """Whether a file is there; raises `ValueError` for anything else of its name, such as a pipe that never ends."""
    if path.exists() and not path.is_file():
        raise ValueError(f"{path} is not a regular file")
    return path.is_file()


def _entry_point(text: str) -> EntryPoint:
    module, _, function = text.partition(":")
    return EntryPoint(module.strip(), function.split("[")[0].strip() or "main")


def read_setup_cfg(folder: Path) -> SetupFile:
    """Read the `setup.cfg` of a package folder; empty if it is missing. Raises `ValueError` with file and line."""
    import configparser  # imported here, as launches without packages do not need it

    parser = configparser.ConfigParser(delimiters=("=",), interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign] -- as the documentation of configparser has it
    try:
        parser.read(folder / "setup.cfg", encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError) as error:
        raise ValueError(f"{folder / 'setup.cfg'}: {error}") from None
    programs, panes = (
        entry_lines(parser.get("options.entry_points", group, fallback="")) for group in ("console_scripts", PANES)
    )
    modules = {}
    if parser.get("options", "packages", fallback="").strip() in ("find:", "find_namespace:"):
        where = parser.get("options.packages.find", "where", fallback="")
        modules = {each.parent.name: each.parent for each in (folder / where).glob("*/__init__.py")}
    return SetupFile(programs, modules=modules, panes=panes)
