"""`ros2 launch --show-args`."""

from __future__ import annotations

import sys
from typing import Any

from launch.launch_description_sources import get_launch_description_from_any_launch_file

HEADER = "Arguments (pass arguments as '<name>:=<value>'):"


def show_args(path: str) -> int:
    """Print the arguments of a launch file with their defaults; returns 1 if the file cannot be read."""
    try:
        description = get_launch_description_from_any_launch_file(path)
    except Exception as error:  # a launch file is a program: its exceptions are reported without a traceback
        return _failed(error)
    print(HEADER)
    try:
        arguments = description.get_launch_arguments()
    except Exception as error:
        return _failed(error)
    _print(arguments)
    return 0


def print_arguments(description: Any) -> None:
    """Print the arguments of a launch description with their defaults; propagates exceptions of included files."""
    print(HEADER)
    _print(description.get_launch_arguments())


def _print(arguments: list[Any]) -> None:
    if not arguments:
        print("\n  No arguments.")
    for each in arguments:
        print(_text(each))
    if any(each._conditionally_included for each in arguments):
        print("\n* argument(s) which are only used if specific conditions occur")


def _failed(error: Exception) -> int:
    print(f"{type(error).__name__}: {error}", file=sys.stderr)
    return 1


def _text(argument: Any) -> str:
    star = "*" if argument._conditionally_included else ""
    lines = ["", f"    '{argument.name}':{star}", f"        {argument.description}"]
    if argument.default_value is not None:
        lines.append(f"        (default: {' + '.join(each.describe() for each in argument.default_value)})")
    return "\n".join(lines)
