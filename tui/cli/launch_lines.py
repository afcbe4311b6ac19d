"""Handles the console's `ros2 run` and `ros2 launch` lines, whose processes keep running and are in the Launch pane."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from bot_console.runtime.workspace.not_found import no_package
from bot_console.tui.cli.program_launch import program_arguments
from bot_console.tui.session.embedded.workspaces import PROGRAM_LAUNCH


@dataclass(frozen=True)
class LaunchRequest:
    """A launch file and its arguments, or `problem`, the reason why the line cannot be launched."""

    name: str = ""
    file: str = ""
    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    problem: str = ""


def parse_launch_line(words: Sequence[str]) -> LaunchRequest | None:
    """The launch file that a line starts; None if it starts nothing, such as `launch --show-args`."""
    if len(words) < 2 or words[0] not in ("run", "launch") or words[1].startswith("-"):
        return None
    return _run(words[1:]) if words[0] == "run" else _launch(words[1:])


def _run(words: Sequence[str]) -> LaunchRequest:
    arguments, problem = program_arguments(list(words), lambda text: None)
    return LaunchRequest(arguments.get("program", "").rpartition("/")[2], str(PROGRAM_LAUNCH), arguments, problem)


def _launch(words: Sequence[str]) -> LaunchRequest | None:
    from ament_index_python.packages import PackageNotFoundError
    from ros2cli.launch_file import LaunchFileError, find_launch_file, parse_launch_arguments

    if any(each.startswith("-") for each in words):
        return None
    file, *rest = words
    try:
        if not os.path.isfile(file):
            file, rest = find_launch_file(file, rest[0] if rest else None), rest[1:]
        return LaunchRequest(os.path.basename(file), os.path.abspath(file), parse_launch_arguments(rest))
    except (PackageNotFoundError, ValueError):
        return LaunchRequest(problem=no_package(words[0]))
    except LaunchFileError as error:
        return LaunchRequest(problem=str(error))
