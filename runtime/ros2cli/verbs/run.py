"""`ros2 run`: runs one executable in the foreground."""

from __future__ import annotations

import argparse
import os
import shlex
import signal
import subprocess
import sys

from ament_index_python.packages import PackageNotFoundError
from bot_console.runtime.children.child_environment import child_environment
from bot_console.runtime.process.node.main_thread import exit_code_of
from bot_console.runtime.rmw.parameter_file import register_hint_source
from bot_console.runtime.workspace.entry_script import script_of
from bot_console.runtime.workspace.executables import Executable, executables
from bot_console.runtime.workspace.not_found import no_executable, no_package
from bot_console.runtime.workspace.parameter_files import hint_for
from bot_console.runtime.workspace.program import is_python, program
from ros2cli.advice import advise
from ros2cli.command import Command, Result

RQT = {
    "rqt_reconfigure": "parameters",
    "rqt_console": "logs",
    "rqt_graph": "graph",
    "rqt_plot": "plot",
    "rqt_robot_steering": "steering",
    "rqt_gui": "overview",
}
"""The console's panes that correspond to rqt's programs."""


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable. Command must be wrapped in quotes if it contains "
        "spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument("argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable")


def _run(arguments: argparse.Namespace) -> Result:
    if arguments.package_name in RQT:
        pane = RQT[arguments.package_name]
        return f"{arguments.package_name} is the pane '{pane}' of the console: open it with 'bot-console --pane {pane}'"
    try:
        found = executables(arguments.package_name)
    except (PackageNotFoundError, ValueError):
        advise(lambda: no_package(arguments.package_name))
        return f"Package '{arguments.package_name}' not found"
    if arguments.executable_name not in found:
        advise(lambda: no_executable(arguments.package_name, arguments.executable_name))
        return "No executable found"
    register_hint_source(hint_for)
    return run(found[arguments.executable_name], arguments.argv, arguments.prefix)


def run(executable: Executable, words: list[str], prefix: str | None = None) -> int:
    """Run an executable in this process if it is Python and has no prefix, else in a child; returns its exit code."""
    runs = None if prefix else program(executable)
    if runs is None:
        code = _wait_for([*shlex.split(prefix or ""), *_command(executable, bool(prefix)), *words])
    else:
        sys.argv = [executable.name, *words]
        code = exit_code_of(runs)
    if code < 0 and os.name == "posix":
        print("[ros2run]:", signal.strsignal(-code))
    elif code:
        print(f"[ros2run]: Process exited with failure {code}")
    return code


def _wait_for(command: list[str]) -> int:
    process = subprocess.Popen(command, env={**child_environment(os.environ), "PYTHONUNBUFFERED": "1"})
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:
            # The child has received the same signal, and ends in its own time.
            continue


def _command(executable: Executable, prefixed: bool) -> list[str]:
    """Return the command of a child; after a prefix, maybe Python itself, Python programs are scripts as on ROS 2."""
    if prefixed:
        return [str(script_of(executable))]
    runner = [sys.executable, "-m", "bot_console.runtime.programs.run"]
    if executable.path is None:
        return [*runner, executable.package, executable.name]
    return [*runner, str(executable.path)] if is_python(executable.path) else [str(executable.path)]


COMMAND = Command("run", "Run a package specific executable", arguments=_arguments, main=_run)
