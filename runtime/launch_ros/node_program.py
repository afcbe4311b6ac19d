"""The program of a node's executable: a Python program that runs in this process, or a command."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_prefix
from bot_console.runtime.programs.python_file_check import examine
from bot_console.runtime.workspace.builtin_package import is_own
from bot_console.runtime.workspace.demos import IMPORT_NAME
from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.entry_script import script_of, script_of_file
from bot_console.runtime.workspace.executables import Executable, executables
from bot_console.runtime.workspace.launched import Program, entry_point, find_packages_in, python_file
from bot_console.runtime.workspace.program import source_folders
from launch.child import PythonProgram
from launch_ros import component_container
from launch_ros.component_container import EXECUTABLES


def program_of(package: str | None, path: str) -> PythonProgram | None:
    """Return the program behind an executable's path; None if it is not Python."""
    if _is_container(package, path):
        threads = 1 if os.path.basename(path) == EXECUTABLES[0] else None
        return _program(container, False, threads)
    executable = _find_executable(package, path)
    if executable is not None and executable.entry_point is not None:
        entry = executable.entry_point
        found = workspace().find(executable.package)
        is_ours = (found is not None and is_own(found)) or entry.module.startswith(f"{IMPORT_NAME}.")
        function = f"{entry.module}:{entry.function}"
        return _program(entry_point, is_ours, function, source_folders(executable.package))
    if not _is_python(path):
        return None
    folders = [os.path.dirname(os.path.abspath(path)), *_above_packages(path), *_prefix_folders(package)]
    only_a_file = package is None and path.endswith(".py")
    calls_main = only_a_file and examine(Path(path)).calls_main
    return _program(python_file, False, path, [*folders, *source_folders()], calls_main)


def _program(kind: Callable[..., Program], is_ours: bool, *arguments: object) -> PythonProgram:
    workspace_folders = [str(each) for each in workspace().folders]
    return PythonProgram(f"{kind.__module__}:{kind.__name__}", (workspace_folders, *arguments), is_ours)


def container(workspace_folders: Sequence[str], threads: int | None) -> Program:
    """Return the program of a component container."""
    find_packages_in(workspace_folders)
    return partial(component_container.main, threads=threads)


def is_this_python(words: Sequence[str]) -> bool:
    """Whether the words before a program are only the name of the Python that is running here."""
    return len(words) == 1 and words[0] in ("python3", "python", sys.executable)


def _is_interpreter(word: str) -> bool:
    return re.fullmatch(r"python[\d.]*", os.path.basename(word)) is not None


def container_path(package: str, executable: str) -> str | None:
    """Return the path that stands for our own container if no other is installed; None for other executables."""
    place = os.path.join(os.path.dirname(os.path.abspath(__file__)), "lib", package, executable)
    return place if _is_container(package, place) else None


def _is_container(package: str | None, path: str) -> bool:
    known = package == component_container.PACKAGE and os.path.basename(path) in EXECUTABLES
    return known and not os.path.isfile(path)


def os_command(package: str | None, command: list[str], at: int) -> list[str]:
    """Return the command, in which a Python executable at `command[at]` is replaced by a script.

    A file that is an argument of Python itself, as in `python3 -m pdb FILE`, is left unchanged: its process finds the
    runtime through the environment.
    """
    executable = _find_executable(package, command[at])
    if executable is not None and executable.entry_point is not None:
        script = str(script_of(executable))
    elif _is_python(command[at]) and not any(map(_is_interpreter, command[:at])):
        script = str(script_of_file(command[at]))
    else:
        return command
    return [*command[:at], script, *command[at + 1 :]]


def _find_executable(package: str | None, path: str) -> Executable | None:
    if package is None or os.path.isfile(path):
        return None
    try:
        return executables(package).get(os.path.basename(path))
    except (PackageNotFoundError, ValueError):
        return None


def _above_packages(path: str) -> list[str]:
    """Return the folder from which a file's Python package is imported, so that the file can import its own modules."""
    folder = Path(path).resolve().parent
    inside = folder
    while (folder / "__init__.py").is_file():
        folder = folder.parent
    return [] if folder == inside else [str(folder)]


def _prefix_folders(package: str | None) -> list[str]:
    """Return the folders from which an installed package's modules are imported."""
    if package is None:
        return []
    try:
        prefix = get_package_prefix(package)
    except (PackageNotFoundError, ValueError):
        return []
    inside = prefix.rstrip(os.sep) + os.sep
    found = [each for each in sys.path if each.startswith(inside)]
    for pattern in ("lib/python*/site-packages", "local/lib/python*/dist-packages"):
        found += [str(each) for each in sorted(Path(prefix).glob(pattern))]
    return list(dict.fromkeys(found))


def _is_python(path: str) -> bool:
    try:
        with open(path, "rb") as file:
            first = file.readline(200)
    except OSError:
        return False
    return path.endswith(".py") or (first.startswith(b"#!") and b"python" in first)
