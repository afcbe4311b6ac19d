"""Distinguishes the user's own code from files of Python, ROS, libraries and this program's runtime."""

from __future__ import annotations

import sysconfig
from functools import cache
from pathlib import Path

import yaml

ROS = "/opt/ros/"
"""The folder in which ROS 2 packages are installed."""


def is_library_file(file: str) -> bool:
    """Whether a file is not the user's code: it belongs to a library or the runtime, or is no file at all."""
    return file.startswith(("<", ROS, *library_folders()))


@cache
def library_folders() -> tuple[str, ...]:
    """The folders of Python, installed packages, console and runtime, both as named and with symbolic links
    resolved.
    """
    folders = [sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")]
    folders.append(str(Path(yaml.__file__).parents[1]))  # where our dependencies are installed, if elsewhere
    folders += [str(Path(__file__).parents[1]), str(Path(__file__).parents[2] / "runtime"), *_folders_of_launch()]
    return tuple(dict.fromkeys(each for folder in folders for each in (folder, str(Path(folder).resolve()))))


def _folders_of_launch() -> list[str]:
    """The folders of `launch` and `launch_ros`, if they can be imported."""
    try:
        import launch_ros

        import launch
    except ImportError:
        return []
    return [str(Path(module.__file__).parent.parent) for module in (launch, launch_ros) if module.__file__]
