"""Turns a program named by the user into arguments of the launch file that runs it."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.runtime.programs.python_file_check import examine
from bot_console.runtime.workspace.available_names import all_executable_names, package_names
from bot_console.runtime.workspace.builtin_package import PAGE_NAME
from bot_console.runtime.workspace.not_found import no_executable, no_package


def program_arguments(words: list[str], hint: Callable[[str], None]) -> tuple[dict[str, str], str]:
    """The arguments for `program.launch.py`, and why the program cannot run, if so; `words` are those after `run`.

    `hint` is called with warnings about a file that can run nevertheless.
    """
    install()
    if words[0].endswith(".py") or os.path.isfile(words[0]):
        return {"program": str(Path(words[0]).resolve()), "words": shlex.join(words[1:])}, _fault(Path(words[0]), hint)
    package, executable, *rest = [*words, ""]
    names = all_executable_names(package)
    if package not in (*package_names(), PAGE_NAME):
        return {}, no_package(package)
    if not executable or executable.startswith("-"):
        return {}, f"name an executable of package '{package}' as well; it has: {', '.join(names) or 'none'}"
    arguments = {"package": package, "program": executable, "words": shlex.join(rest[:-1])}
    return arguments, "" if executable in names else no_executable(package, executable)


def _fault(file: Path, hint: Callable[[str], None]) -> str:
    if not os.path.isfile(file):  # `Path` raises if the name is too long.
        return f"{file} does not exist"
    found = examine(file)
    if found.hint:
        hint(found.hint)
    return found.problem
