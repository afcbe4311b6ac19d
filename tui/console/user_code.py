"""Which files are a person's own code, and which belong to Python, to ROS or to this program's runtime."""

from __future__ import annotations

import sysconfig
from functools import cache
from pathlib import Path

import yaml

ROS = "/opt/ros/"
"""Where ROS 2 is installed from packages."""


def is_library_file(file: str) -> bool:
    """Whether a file is no code of the user's: a library's, the runtime's, or none that was read from a file."""
    return file.startswith(("<", ROS, *library_folders()))


@cache
def library_folders() -> tuple[str, ...]:
    """The folders of Python, installed packages, console and runtime, as they are named and where they really are."""
    folders = [sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")]
    folders.append(str(Path(yaml.__file__).parents[1]))  # where our dependencies lie, if elsewhere
    folders += [str(Path(__file__).parents[1]), str(Path(__file__).parents[2] / "runtime"), *_folders_of_launch()]
    return tuple(dict.fromkeys(each for folder in folders for each in (folder, str(Path(folder).resolve()))))


def _folders_of_launch() -> list[str]:
    """Where `launch` and `launch_ros` lie, where they can be imported."""
    try:
        import launch_ros

        import launch
    except ImportError:
        return []
    return [str(Path(module.__file__).parent.parent) for module in (launch, launch_ros) if module.__file__]
