"""The launch files of packages, and their arguments."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Generator, Iterable, Sequence

from bot_console.runtime.programs.hints import did_you_mean, is_read
from bot_console.runtime.workspace.available_names import launch_file_names
from ros2cli.advice import launch_files


class LaunchFileError(RuntimeError):
    """A launch file does not exist, or a launch argument is malformed."""


def find_launch_file(package: str, name: str | None) -> str:
    """Return a package's launch file, which may be anywhere in its share folder; raises `LaunchFileError`."""
    from ament_index_python.packages import get_package_share_directory

    share = get_package_share_directory(package)
    if name is None:
        raise LaunchFileError(_unnamed(package))
    found = [
        os.path.join(folder, name)
        for folder, _, files in os.walk(share, followlinks=True)
        for each in files
        if each == name
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


def _unnamed(package: str) -> str:
    """Return the message for a command line with only a package, where upstream looks for a file called None."""
    names = launch_file_names(package)
    return f"name a launch file of package '{package}': {', '.join(names)}" if names else launch_files(package, ())


def named_launch_file(named: str, words: Sequence[str]) -> tuple[str, list[str]]:
    """Return the launch file, given as a path or as a package and the first of `words`, and the remaining words.

    Raises `LaunchFileError` with the message of `ros2 launch`.
    """
    if os.path.isfile(named):
        return named, [*words]
    with package_errors_converted(named):
        return find_launch_file(named, words[0] if words else None), [*words[1:]]


@contextlib.contextmanager
def package_errors_converted(named: str) -> Generator[None]:
    """Convert errors about an unknown or invalid package name to `LaunchFileError`."""
    from ament_index_python.packages import PackageNotFoundError

    try:
        yield
    except PackageNotFoundError as error:
        raise LaunchFileError(f"Package '{named}' not found: {error}") from None
    except ValueError as error:
        raise LaunchFileError(_no_file(named) if is_read() else _as_upstream(named, error)) from None


def _no_file(named: str) -> str:
    """Return the message for a person whose path is not a file."""
    if os.path.isdir(named):
        return f"{named} is a folder; name a launch file in it, or a package and its launch file"
    folder, name = os.path.split(named)
    try:
        near = did_you_mean(name, os.listdir(folder or "."), similarity=0.85)  # the endings are similar
    except OSError:
        near = ""
    return f"there is no launch file {named}{near}"


def _as_upstream(named: str, error: ValueError) -> str:
    """Return upstream's output for such a path, with an explanation inserted."""
    kind = "a folder" if os.path.isdir(named) else "not a file here"
    return (
        f"Traceback (most recent call last):\n  {named} is {kind}, so it was read as a package name\n"
        f"ValueError: {error}"
    )


def parse_launch_arguments(words: Iterable[str]) -> dict[str, str]:
    """Return values by name; the last one counts. Raises `LaunchFileError` for anything but `name:=value`."""
    found: dict[str, str] = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not (name and separator and value):
            raise LaunchFileError(f"malformed launch argument '{word}', expected format '<name>:=<value>'")
        found[name] = value
    return found
