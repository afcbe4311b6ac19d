"""The program of a workspace executable, to be run in a node process or in the real process."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from bot_console.runtime.importer import places_of
from bot_console.runtime.process import entry_point_program, file_program
from bot_console.runtime.workspace.builtin_package import own_is_first
from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.executables import Executable

Program = Callable[[], object]


def program(executable: Executable) -> Program | None:
    """Return the function that runs an executable in the calling process; None if it is not Python."""
    entry = executable.entry_point
    if entry is not None:
        places = places_of(source_folders(executable.package), ours_first=own_is_first())
        return entry_point_program(f"{entry.module}:{entry.function}", places)
    if executable.path is not None and is_python(executable.path):
        return python_file(executable.path)
    return None


def python_file(path: Path) -> Program:
    """Return the function that runs a Python file in the calling process; it can import the workspace's packages."""
    return file_program(str(path), places_of([str(path.resolve().parent), *source_folders()]))


def source_folders(first: str = "") -> list[str]:
    """Return the folders of the workspace's Python packages, starting with those of the package `first`."""
    packages = workspace().packages
    ordered = sorted(packages, key=lambda name: name != first)
    folders = (str(path.parent) for name in ordered for path in packages[name].modules.values())
    return list(dict.fromkeys(folders))


def is_python(path: Path) -> bool:
    """Whether a file is a Python program, judged by its name or first line; False for an unreadable one."""
    try:
        with path.open("rb") as file:
            first = file.readline(200)
    except OSError:
        return False
    return path.suffix == ".py" or (first.startswith(b"#!") and b"python" in first)
