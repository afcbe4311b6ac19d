"""Launch files of packages, and arguments for them."""

from __future__ import annotations

import os
from collections.abc import Iterable


class LaunchFileError(RuntimeError):
    """A launch file that is not there, or an argument that is malformed."""


def find_launch_file(package: str, name: str | None) -> str:
    """The path of a package's launch file, which may be anywhere in its share folder; raises `LaunchFileError`."""
    from ament_index_python.packages import get_package_share_directory

    share = get_package_share_directory(package)
    found = [
        os.path.join(folder, name)
        for folder, _, files in os.walk(share, followlinks=True)
        for each in files
        if each == name and name is not None
    ]
    if not found:
        raise LaunchFileError(
            f"file '{name}' was not found in the share directory of package '{package}' which is at '{share}'"
        )
    if len(found) > 1:
        raise LaunchFileError(
            f"file '{name}' was found more than once in the share directory of package '{package}': {found}"
        )
    return found[0]


def parse_launch_arguments(words: Iterable[str]) -> dict[str, str]:
    """Names and values, the last of a name; raises `LaunchFileError` for anything but `name:=value`."""
    found: dict[str, str] = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not (name and separator and value):
            raise LaunchFileError(f"malformed launch argument '{word}', expected format '<name>:=<value>'")
        found[name] = value
    return found
