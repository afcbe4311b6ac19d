"""The title of a launch in the list of processes."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from itertools import count
from pathlib import Path

PROGRAM = "program.launch.py"
"""The launch file behind `ros2 run`, which runs one program; users think of that program, not of this file."""


def title_of(path: str, arguments: Mapping[str, str]) -> str:
    """The name of a launch file, or of the single program that it runs for `ros2 run`."""
    name = Path(path).name
    return Path(arguments.get("program", name)).name if name == PROGRAM else name


def argument_line(path: str, arguments: Mapping[str, str]) -> str:
    """The request as a user would type it: a launch file with its arguments, or a program."""
    if Path(path).name == PROGRAM and "program" in arguments:
        words = (arguments.get(each, "") for each in ("package", "program", "words"))
        return " ".join(["run", *(each for each in words if each)])
    return " ".join(["launch", path, *(f"{name}:={value}" for name, value in arguments.items())])


def unique_title(title: str, used: Collection[str]) -> str:
    """Append a number to a title if another launch in the list has the same one."""
    return next(each for number in count(1) if (each := title if number == 1 else f"{title} ({number})") not in used)
