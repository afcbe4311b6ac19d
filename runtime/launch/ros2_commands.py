"""`ros2 ...` as a command of a launch file: answered by this runtime's own verbs, which see the nodes of the launch."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Callable, Sequence

from launch.child import PythonProgram

NEEDS_SHELL = re.compile(r"[;&|<>()`$*?#~\n]|\[[^\]]*\]")
"""What a shell would do something with, outside of quotes."""
APART = ("bag", "daemon", "doctor", "wtf")
"""Commands of `ros2` that are programs of their own, and no verbs of this runtime's."""
QUOTED = re.compile(r"'[^']*'|\"[^\"`$\\]*\"")


def ros2_program(command: Sequence[str], shell: bool) -> PythonProgram | None:
    """A command that is nothing but a `ros2` command line, as a program; None for all others."""
    words = ros2_words(command, shell)
    return None if words is None else PythonProgram("launch.ros2_commands:verb", (words,), is_ours=True)


def ros2_words(command: Sequence[str], shell: bool) -> list[str] | None:
    """The words behind `ros2` of a command that is nothing but a `ros2` command line; None for all others.

    Also None where the command is a program of its own, such as `ros2 bag`: that is started as any other.
    """
    words = list(command)
    if shell:
        line = " ".join(command)
        if NEEDS_SHELL.search(QUOTED.sub("", line)):
            return None
        try:
            words = shlex.split(line)
        except ValueError:  # the shell says better what is wrong with it
            return None
    if not words or os.path.basename(words[0]) != "ros2" or (words[1:2] and words[1] in APART):
        return None
    return words[1:]


def verb(words: Sequence[str]) -> Callable[[], object]:
    """A callable that runs a `ros2` command line and ends with its exit code."""

    def run() -> object:
        import sys

        from ros2cli.command_line import main

        sys.exit(main(list(words)))

    return run
