"""Runs one node as the main program of this process, as `bot-console run` does without options.

The arguments are `FILE.py`, `-m MODULE`, `-c CODE` or `PACKAGE EXECUTABLE`, followed by the node's. Nothing is virtual
here: the node has the real main thread, signals and standard streams.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.children.child_environment import child_environment
from bot_console.runtime.children.ros_wheels import clear_wheel_environment
from bot_console.runtime.importer import install, places_of
from bot_console.runtime.process import MAIN, code_program, current, module_program
from bot_console.runtime.rmw.parameter_file import register_hint_source
from bot_console.runtime.shim_folder import shim_folder
from bot_console.runtime.workspace.executables import executables
from bot_console.runtime.workspace.parameter_files import hint_for
from bot_console.runtime.workspace.program import Program, program, python_file, source_folders

PYTHON_OPTIONS = {"-m": "bot-console run -m MODULE", "-c": "bot-console run -c CODE"}
"""Options of the interpreter that `run` accepts instead of a file."""
INTERRUPTED = 130
"""The exit code that shells report for a program ended by SIGINT."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the program that the arguments name and return its exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    install()
    register_hint_source(hint_for)
    _let_children_import()
    if not words:
        return _refuse("name a file or a package: bot-console run FILE.py, or bot-console run PACKAGE EXECUTABLE")
    if words[0][:2] in PYTHON_OPTIONS:
        return run_as_python(words)
    if words[0].endswith(".py") or Path(words[0]).is_file():
        return run_file(Path(words[0]), words[1:])
    return run_package(words[0], words[1:])


def run_as_python(words: Sequence[str]) -> int:
    """Run `-m MODULE` or `-c CODE` with arguments, as the interpreter does."""
    option, joined = words[0][:2], words[0][2:]
    rest = [joined, *words[1:]] if joined else [*words[1:]]
    if not rest:
        print(f"argument expected for the {option} option: {PYTHON_OPTIONS[option]}", file=sys.stderr)
        return 2
    kind = module_program if option == "-m" else code_program
    return _run(kind(rest[0], places_of(source_folders())), [option, *rest[1:]])


def _let_children_import() -> None:
    """Make rclpy importable for the programs that this one starts, including those of `multiprocessing`."""
    os.environ.update(child_environment(os.environ))
    if os.name == "posix":
        sys.path.append(str(shim_folder()))  # a spawned process inherits this path


def run_package(package: str, words: Sequence[str]) -> int:
    """Run a package's executable; `words` are its name and its arguments."""
    from ament_index_python.packages import PackageNotFoundError
    from bot_console.runtime.workspace.not_found import no_executable, no_package

    try:
        found = executables(package)
    except (PackageNotFoundError, ValueError):
        return _refuse(no_package(package))
    if not words or words[0].startswith("-"):
        choices = ", ".join(sorted(found)) or "none"
        return _refuse(f"name an executable of package '{package}' as well; it has: {choices}")
    name, *arguments = words
    if name not in found:
        return _refuse(no_executable(package, name))
    runs = program(found[name])
    if runs is not None:
        return _run(runs, [name, *arguments])
    from ros2cli.verbs.run import run

    return run(found[name], arguments)


def run_file(path: Path, words: Sequence[str]) -> int:
    """Run a Python file as `python FILE` does; if it only defines `main()`, call that, as `ros2 run` would."""
    from bot_console.runtime.programs.python_file_check import examine, run_then_main

    if not path.is_file():
        return _refuse(f"{path} does not exist")
    found = examine(path)
    if found.problem:
        return _refuse(found.problem)
    if found.hint:
        print(f"[WARN] [bot-console]: {found.hint}", file=sys.stderr)
    runs = python_file(path)
    return _run(run_then_main(runs) if found.calls_main else runs, [str(path), *words])


def _run(runs: Program, argv: Sequence[str]) -> int:
    """Run a program to its end; the traceback of an uncaught exception begins in the user's own file."""
    from bot_console.runtime.process.ending import wait_for_threads
    from bot_console.runtime.process.node.main_thread import SIGINT_EXIT, exit_code_of

    sys.argv = list(argv)
    code = exit_code_of(runs)
    if current() is MAIN:  # otherwise the node process does so when it ends
        wait_for_threads()
    return INTERRUPTED if code == SIGINT_EXIT else code


def _refuse(text: str) -> int:
    print(text, file=sys.stderr)
    return 1


if __name__ == "__main__":
    clear_wheel_environment()
    sys.exit(main())
