"""The launch file that `--launch` means: a path, or a package and one of its launch files, as `ros2 launch` has it."""

from __future__ import annotations

import os
from dataclasses import replace

from bot_console.tui.cli.arguments import Options

PATHS = (".py", ".xml", ".yaml", ".yml")
"""What a single word ends in that is meant as a path; no package is named so."""


def with_launch_file(options: Options) -> tuple[Options, str]:
    """The options with the path of the launch file, and why there is none; `launch` finds the same with its arguments.

    Packages are looked for where the options say, else in the working directory.
    """
    named, name = options.launch, options.launch_file
    if not named or (not name and os.path.isfile(named)):
        return options, ""
    if not name and (os.sep in named or named.endswith(PATHS)):
        return options, f"there is no launch file {named}"
    from bot_console.runtime.importer import install
    from bot_console.tui.cli.system.workspaces import choose, report_workspace

    install()
    choose(options.workspace)
    from ros2cli.launch_file import LaunchFileError, named_launch_file, parse_launch_arguments

    try:
        path, left = named_launch_file(named, [name] if name else [])
        parse_launch_arguments(left)  # a word behind a path that is no argument
    except LaunchFileError as error:
        return options, str(error)
    report_workspace(named)
    return replace(options, launch=os.path.abspath(path), launch_file=""), ""
