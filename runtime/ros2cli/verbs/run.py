"""`ros2 run`: one executable, in the foreground."""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys

from ament_index_python.packages import PackageNotFoundError
from bot_console.runtime.workspace.executables import Executable, executables
from ros2cli.command import Command, Result

RQT = {
    "rqt_reconfigure": "parameters",
    "rqt_console": "logs",
    "rqt_graph": "graph",
    "rqt_plot": "plot",
    "rqt_robot_steering": "steering",
    "rqt_gui": "overview",
}
"""Panes of the console that stand for rqt's programs."""


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
        return f"Package '{arguments.package_name}' not found"
    if arguments.executable_name not in found:
        return "No executable found"
    return run(found[arguments.executable_name], arguments.argv, arguments.prefix)


def run(executable: Executable, words: list[str], prefix: str | None = None) -> int:
    """Run an executable in this process where it is Python and no prefix is asked for, else as one of its own."""
    if executable.entry_point and not prefix:
        from bot_console.runtime.run import run_entry_point

        return run_entry_point(executable, words)
    command = [*shlex.split(prefix or ""), *_command(executable), *words]
    process = subprocess.Popen(command, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    while True:
        try:
            code = process.wait()
            break
        except KeyboardInterrupt:
            # The child has had the same signal and ends in its own time.
            continue
    if os.name != "nt" and code < 0:
        code += 256
        print(f"[ros2run]: Process exited with failure {code}", file=sys.stderr)
    return code


def _command(executable: Executable) -> list[str]:
    if executable.path:
        return [str(executable.path)]
    return [sys.executable, "-m", "bot_console.runtime.run", executable.package, executable.name]


COMMAND = Command("run", "Run a package specific executable", arguments=_arguments, main=_run)
