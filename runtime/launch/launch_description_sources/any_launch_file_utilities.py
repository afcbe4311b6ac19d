"""Launch files of any kind."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING

from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_place import report_place

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.frontend.parser import Parser
    from launch.launch_description import LaunchDescription


def get_launch_description_from_frontend_launch_file(
    launch_file_path: str, *, parser: type[Parser] | None = None
) -> LaunchDescription:
    """Return the description in an XML or YAML launch file."""
    from launch.frontend import Parser

    root = None
    try:
        root, used = (parser or Parser).load(launch_file_path)
        return used.parse_description(root)
    except Exception as error:
        report_place(error, launch_file_path, (root.line or None) if root else None)
        raise


def get_launch_description_from_any_launch_file(
    launch_file_path: str, *, parser: type[Parser] | None = None
) -> LaunchDescription:
    """Return the description in a launch file; raises `InvalidLaunchFileError` with the errors of all readers."""
    from launch.launch_description_sources.python_launch_file_utilities import (
        get_launch_description_from_python_launch_file,
    )

    extension = os.path.splitext(launch_file_path)[1].removeprefix(".")
    readers: list[Callable[[str], LaunchDescription]] = [
        partial(get_launch_description_from_frontend_launch_file, parser=parser),
        get_launch_description_from_python_launch_file,
    ]
    if extension == "py":
        readers.reverse()
    errors: list[BaseException] = []
    for read in readers:
        try:
            return read(launch_file_path)
        except Exception as error:  # a launch file may raise anything; all readers' errors are reported
            errors.append(error)
    raise InvalidLaunchFileError(extension, likely_errors=errors)
