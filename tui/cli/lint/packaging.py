"""Finds faults of packages that work here, where they are read from their sources, but not on ROS 2, where `colcon
build` installs them.
"""

from __future__ import annotations

import ast
import configparser
import os
import re
import sys
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import NamedTuple

from bot_console.runtime.importer import PACKAGES, generated_packages
from bot_console.runtime.interfaces.further_interfaces import unverified_folders
from bot_console.runtime.workspace.package import Package

TESTS = frozenset({"test", "tests", "__pycache__"})
SECTIONS = (("develop", "script_dir"), ("install", "install_scripts"))
MAX_NAMED_FILES = 3
INSTALLED = ("launch/*launch.py", "launch/*launch.xml", "launch/*launch.yaml", "config/*.yaml", "params/*.yaml")
"""Patterns of files that other programs look for in the share folder of a package."""


class Obstacle(NamedTuple):
    """A fault that keeps a package from working on ROS 2; `line` is 0 if it concerns the whole file."""

    file: Path
    line: int
    problem: str
    fix: str

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}" if self.line else str(self.file)
        return f"{where}: {self.problem}; {self.fix}"


def obstacles(package: Package) -> list[Obstacle]:
    """All obstacles of a package, in the order of files; empty if the package cannot be read at all."""
    found: list[Obstacle] = []
    if package.build_type == "ament_python" and not package.problem and (package.folder / "setup.py").is_file():
        found += _setup_cfg(package)
        found += _setup_name(package)
        found += _entries(package)
        found += _packages(package)
        found += [*_data_files(package)] or _not_installed(package)
    found += _programs(package)
    for folder in {*package.modules.values(), *(each.parent for each in package.scripts.values())}:
        for path in sorted(folder.glob("*.py")) if folder.is_dir() else ():
            found += shadowing_files(path)
    return sorted(found)


def defects(package: Package) -> list[Obstacle]:
    """What keeps a package from working anywhere: files that cannot be read, executables whose module is missing."""
    if package.problem:
        place, line, problem = _located(package.problem, package.folder)
        return [Obstacle(place, line, problem, "correct it, then run lint again")]
    setup, targets = package.folder / "setup.py", package.setup.console_scripts if package.setup is not None else {}
    return [
        Obstacle(setup, _entry_line(package), f"{name} is {entry.module}:{entry.function}, and there is no such module",
                 "correct the entry, or add the file")
        for name, entry in package.executables.items()
        if ":" in targets.get(name, "")
        and (first := package.modules.get(entry.module.partition(".")[0])) is not None
        and not _has_module(first, entry.module.split(".")[1:])
    ]  # fmt: skip


def _located(problem: str, folder: Path) -> tuple[Path, int, str]:
    """The file and the line with which the text of a problem begins, and the rest of the text."""
    problem = " ".join(problem.split())  # configparser writes several lines
    found = re.match(rf"{re.escape(str(folder))}/([^/:]+)(?::(\d+))?: ", problem)
    if found is None:
        return folder, 0, problem
    return folder / found[1], int(found[2] or 0), problem[found.end() :]


def _has_module(folder: Path, parts: list[str]) -> bool:
    """Whether a Python package has a module; a `folder` that is a file is itself the module."""
    path = folder.joinpath(*parts)
    return path.is_dir() or path.with_name(f"{path.name}.py").is_file() or (path.is_file() and not parts)


def _entry_line(package: Package) -> int:
    return package.setup.lines.get("entry_points", 0) if package.setup is not None else 0


def _entries(package: Package) -> Iterator[Obstacle]:
    """Entry points without a function, for which the script of an installed package calls the module."""
    for name, target in package.setup.console_scripts.items() if package.setup is not None else ():
        if ":" not in target:
            yield Obstacle(package.folder / "setup.py", _entry_line(package), f"'{name} = {target}' names no function",
                           f"write '{name} = module:function'")  # fmt: skip


def shadowing_files(path: Path) -> Iterator[Obstacle]:
    """Files beside a Python file that Python would import instead of a ROS package or a standard module."""
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, ValueError, MemoryError, RecursionError):
        return
    names = known_names()
    for node in ast.walk(tree):
        imported: list[str] = []
        if isinstance(node, ast.Import):
            imported = [each.name for each in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            imported = [node.module or ""]
        for name in {each.partition(".")[0] for each in imported}:
            beside = _beside(path, name) if name in names else None
            if beside is not None:
                problem = f"{beside.name} beside it is imported instead of {name} when the file is run by itself"
                yield Obstacle(path, getattr(node, "lineno", 0), problem, f"rename {beside.name}")


def _beside(path: Path, name: str) -> Path | None:
    module, folder = path.with_name(f"{name}.py"), path.with_name(name)
    if module.is_file() and module != path:
        return module
    return folder if (folder / "__init__.py").is_file() and path.parent.name != name else None


def known_names() -> Collection[str]:
    """The names of the ROS packages and of the modules of Python's library."""
    return {*PACKAGES, *generated_packages(), *unverified_folders(), *sys.stdlib_module_names}


def _setup_cfg(package: Package) -> Iterator[Obstacle]:
    """A missing or wrong line of `setup.cfg`, for which executables are installed where `ros2 run` does not look."""
    if not package.executables and not package.scripts:
        return
    path, right = package.folder / "setup.cfg", f"$base/lib/{package.name}"
    fix = f"write `[develop]`, `script_dir={right}`, `[install]`, `install_scripts={right}`, each on its own line"
    effect = "`ros2 run` and launch files do not find its executables"
    if not path.is_file():
        yield Obstacle(path, 0, f"is missing, so that {effect}", fix)
        return
    parser = configparser.ConfigParser(interpolation=None)
    try:
        parser.read(path, encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError):
        return  # reported already as a mistake of the package
    for section, option in SECTIONS:
        keys = [each for each in (option, option.replace("_", "-")) if parser.has_option(section, each)]
        value = parser.get(section, keys[0]).strip() if keys else ""
        line = _line_of(path, keys[0] if keys else f"[{section}]")
        if not keys:
            yield Obstacle(path, line, f"[{section}] has no {option}, so that {effect}", f"write {option}={right}")
        elif value.rstrip("/") != right:
            yield Obstacle(path, line, f"{keys[0]} is {value}, so that {effect}", f"write {keys[0]}={right}")


def _setup_name(package: Package) -> Iterator[Obstacle]:
    setup = package.setup
    if setup is not None and setup.name and setup.name != package.name:
        path = package.folder / "setup.py"
        problem = f"setup() is called with the name '{setup.name}', and package.xml says '{package.name}'"
        yield Obstacle(path, setup.lines.get("name", 0), problem, f"write name='{package.name}'")


def _packages(package: Package) -> Iterator[Obstacle]:
    """Python packages that are not installed because `packages=` does not list them."""
    setup = package.setup
    if setup is None or setup.packages is None:
        return
    path, line, listed = package.folder / "setup.py", setup.lines.get("packages", 0), set(setup.packages)
    for name, folder in package.modules.items():
        for inner in sorted(folder.rglob("*")) if folder.is_dir() else ():
            dotted = ".".join((name, *inner.relative_to(folder).parts))
            if not inner.is_dir() or dotted in listed or not next(inner.glob("*.py"), None):
                continue
            if TESTS & set(inner.relative_to(folder).parts):
                continue
            init = (
                ""
                if (inner / "__init__.py").is_file()
                else f"give {inner.relative_to(package.folder)} an __init__.py and "
            )
            yield Obstacle(path, line, f"packages= does not list {dotted}, so it is not installed",
                           f"{init}add '{dotted}' to packages=, or write packages=find_packages()")  # fmt: skip
    for executable, entry in package.executables.items():
        first = entry.module.partition(".")[0]
        if first not in {each.partition(".")[0] for each in listed} and (package.folder / first).is_dir():
            yield Obstacle(path, line, f"packages= does not list {first}, where {executable} is",
                           f"add '{first}' to packages=")  # fmt: skip


def _data_files(package: Package) -> Iterator[Obstacle]:
    """Rows of `data_files` that install nothing or name missing files."""
    path = package.folder / "setup.py"
    for row in package.setup.rows if package.setup is not None else ():
        missing = [each for each in row.files if not each.exists()]
        if missing:
            names = ", ".join(str(each.relative_to(package.folder)) for each in missing[:MAX_NAMED_FILES])
            yield Obstacle(
                path, row.line, f"data_files names {names}, which does not exist", "correct the name, or remove it"
            )
        elif not row.files and row.written:
            yield Obstacle(path, row.line, f"{row.written} matches no file, so that {row.target} stays empty",
                           _what_is_there(package.folder, row.written))  # fmt: skip


def _not_installed(package: Package) -> Iterator[Obstacle]:
    """Launch and parameter files in their usual folders that no row of `data_files` installs."""
    if package.setup is None or not package.setup.has_all_rows:
        return
    installed = {each.resolve() for _, sources in package.data_files for each in sources}
    line = package.setup.lines.get("data_files", 0)
    for pattern in INSTALLED:
        for path in sorted(package.folder.glob(pattern)):
            if path.resolve() not in installed:
                name = path.relative_to(package.folder)
                yield Obstacle(package.folder / "setup.py", line,
                               f"{name} is not installed: data_files has no line for it",
                               f"add ('share/{package.name}/{name.parent}', glob('{pattern}'))")  # fmt: skip


def _what_is_there(folder: Path, written: str) -> str:
    """The hint for a pattern that matches nothing: the files in the folder that it names, if there are any."""
    for name in ("launch", "config", "params", "rviz", "urdf", "worlds", "maps", "meshes"):
        there = sorted(each.name for each in (folder / name).glob("*") if each.is_file()) if name in written else []
        if there:
            return f"correct the pattern: {name}/ contains {', '.join(there[:MAX_NAMED_FILES])}"
    return "correct the pattern, or remove the row"


def _programs(package: Package) -> Iterator[Obstacle]:
    """Files that are installed as programs, but cannot be started."""
    for path in package.scripts.values():
        try:
            begin = path.open("rb").read(4)
        except OSError:
            continue
        if path.suffix == ".py" and not begin.startswith(b"#!"):
            yield Obstacle(path, 1, "the program does not begin with a line that names its interpreter",
                           "write `#!/usr/bin/env python3` as its first line")  # fmt: skip
        if os.name == "posix" and not os.access(path, os.X_OK):
            yield Obstacle(path, 0, "the program is not executable", f"chmod +x {path}")


def _line_of(path: Path, begin: str) -> int:
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    return next((at for at, line in enumerate(lines, 1) if line.strip().startswith(begin)), 0)
