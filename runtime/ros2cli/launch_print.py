"""`ros2 launch --print` and `--show-args`: the tree and the arguments of a launch file, without running it."""

from __future__ import annotations

import sys
from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from bot_console.runtime.programs.hints import returns_no_description
from launch.launch_description import LaunchDescription
from launch.launch_description_sources import get_launch_description_from_any_launch_file
from launch.launch_introspector import LaunchIntrospector


def print_resolved(path: str, arguments: Mapping[str, str]) -> int:
    """Print the fully evaluated tree of a launch file; returns 1 if the launch would fail."""
    from launch_ros.resolved_description import resolve_description

    return _print(resolve_description(path, arguments))


def print_description(path: str) -> int:
    """Print the tree of a launch file; returns 1 if the file cannot be read."""
    return _print(_tree(path))


def show_args(path: str) -> int:
    """Print the arguments of a launch file with their defaults; returns 1 if the file cannot be read."""
    return _print(_arguments(path))


def _print(lines: Iterator[str]) -> int:
    """Print lines as they are found; exceptions of a launch file, which is a program, are printed without traceback."""
    while True:
        try:
            line = next(lines, None)
        except Exception as error:
            print(f"{type(error).__name__}: {error}", file=sys.stderr)
            return 1
        if line is None:
            return 0
        print(line)


def _tree(path: str) -> Iterator[str]:
    description = get_launch_description_from_any_launch_file(path)
    with _explained(description):
        yield LaunchIntrospector().format_launch_description(description)


def _arguments(path: str) -> Iterator[str]:
    description = get_launch_description_from_any_launch_file(path)
    with _explained(description):
        yield from argument_lines(description)


@contextmanager
def _explained(description: object) -> Generator[None]:
    """Add to an `AttributeError` what a launch file has to return, if it has returned something else."""
    try:
        yield
    except AttributeError as error:
        if isinstance(description, LaunchDescription):
            raise
        raise AttributeError(f"{error}: {returns_no_description(description)}") from None


def argument_lines(description: Any) -> Iterator[str]:
    """Yield the arguments of a launch description with their defaults; raises the errors of included files."""
    yield "Arguments (pass arguments as '<name>:=<value>'):"
    arguments = description.get_launch_arguments()
    if not arguments:
        yield "\n  No arguments."
    for each in arguments:
        star = "*" if each._conditionally_included else ""
        yield f"\n    '{each.name}':{star}\n        {each.description}"
        if each.default_value is not None:
            yield f"        (default: {' + '.join(part.describe() for part in each.default_value)})"
    if any(each._conditionally_included for each in arguments):
        yield "\n* argument(s) which are only used if specific conditions occur"
