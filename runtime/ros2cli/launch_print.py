"""`ros2 launch --print`."""

from __future__ import annotations

import sys
from collections.abc import Mapping

from launch.launch_description_sources import get_launch_description_from_any_launch_file
from launch.launch_introspector import LaunchIntrospector
from launch_ros.resolved_description import resolve_description


def print_resolved(path: str, arguments: Mapping[str, str]) -> int:
    """Print the tree of a launch file with everything evaluated; returns 1 if the launch would fail."""
    try:
        for line in resolve_description(path, arguments):
            print(line)
    except Exception as error:  # a launch file is a program: its exceptions are reported without a traceback
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        return 1
    return 0


def print_description(path: str) -> int:
    """Print the tree of a launch file; returns 1 if the file cannot be read."""
    try:
        description = get_launch_description_from_any_launch_file(path)
        text = LaunchIntrospector().format_launch_description(description)
    except Exception as error:  # a launch file is a program: its exceptions are reported without a traceback
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        return 1
    print(text)
    return 0
