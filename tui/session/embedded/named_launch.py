"""Finds the launch file that `--launch` names: by its path, or by a package and its name, as in `ros2 launch`."""

from __future__ import annotations

import os
from dataclasses import replace

from bot_console.tui.cli.arguments import Options

PATHS = (".py", ".xml", ".yaml", ".yml")
"""The suffixes by which a word is recognised as a path; package names have none of them."""


def with_launch_file(options: Options) -> tuple[Options, str]:
    """The options with the path of the launch file, and the reason if there is none; `launch` finds the same file.

    Packages are searched in the folders of the options, or else in the working directory.
    """
    named, name = options.launch, options.launch_file
    if not named or (not name and os.path.isfile(named)):
        return options, ""
    if not name and (os.sep in named or named.endswith(PATHS)):
        return options, f"there is no launch file {named}"
    from bot_console.runtime.importer import install
    from bot_console.tui.session.embedded.workspaces import choose, report_workspace

    install()
    choose(options.workspace)
    from ros2cli.launch_file import LaunchFileError, named_launch_file, parse_launch_arguments

    try:
        path, left = named_launch_file(named, [name] if name else [])
        parse_launch_arguments(left)  # raises for a word after a path that is not an argument
    except LaunchFileError as error:
        return options, str(error)
    report_workspace(named)
    return replace(options, launch=os.path.abspath(path), launch_file=""), ""
