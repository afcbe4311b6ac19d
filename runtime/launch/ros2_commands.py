"""`ros2 ...` as a command in a launch file: this runtime's own verbs run it, and see the launch's nodes."""

from __future__ import annotations

import os
import re
import shlex
import sys
from collections.abc import Callable, Sequence

from bot_console.runtime.workspace.discover import workspace
from launch.child import PythonProgram

NEEDS_SHELL = re.compile(r"[;&|<>()`$*?#~\n]|\[[^\]]*\]")
"""Characters outside quotes that a shell would interpret."""
SEPARATE_PROGRAMS = ("bag", "daemon", "doctor", "wtf")
"""`ros2` commands that are separate programs, not verbs of this runtime."""
QUOTED = re.compile(r"'[^']*'|\"[^\"`$\\]*\"")


def ros2_program(command: Sequence[str], shell: bool) -> PythonProgram | None:
    """Return a program for a command that is a single `ros2` command line; None for any other command.

    The program is ours, except for `ros2 run`, which becomes the program that it runs.
    """
    words = ros2_words(command, shell)
    if words is None:
        return None
    folders = [str(each) for each in workspace().folders]
    return PythonProgram("launch.ros2_commands:verb", (folders, words), is_ours=words[:1] != ["run"])


def ros2_words(command: Sequence[str], shell: bool) -> list[str] | None:
    """Return the arguments of a command that is a single `ros2` command line; None for any other command.

    Also None for commands that are separate programs, such as `ros2 bag`, which are started like any others.
    """
    words = list(command)
    if shell:
        line = " ".join(command)
        if NEEDS_SHELL.search(QUOTED.sub("", line)):
            return None
        try:
            words = shlex.split(line)
        except ValueError:  # the shell's error message is better
            return None
    if not words or os.path.basename(words[0]) != "ros2" or (words[1:2] and words[1] in SEPARATE_PROGRAMS):
        return None
    return words[1:]


def verb(workspace_folders: Sequence[str], words: Sequence[str]) -> Callable[[], object]:
    """Return a callable that runs a `ros2` command line and exits with its exit code."""
    from bot_console.runtime.workspace.launched import find_packages_in

    find_packages_in(workspace_folders)

    def run() -> object:
        from ros2cli.command_line import main

        sys.exit(main(list(words)))

    return run
