"""`bot-console export DIR`: the robot's package, for a machine with ROS 2 and colcon."""

from __future__ import annotations

import argparse
from pathlib import Path


def run(words: list[str]) -> int:
    """Write the package and say where."""
    parser = argparse.ArgumentParser("bot-console export", description="Write the robot's package for colcon.")
    parser.add_argument("folder", type=Path, metavar="DIR", help="where the package's folder is made")
    given = parser.parse_args(words)
    from bot_console.runtime.workspace.exporting import NAME, export

    try:
        place = export(given.folder)
    except (OSError, ValueError) as error:
        parser.exit(1, f"not exported: {error}\n")
    print(f"{place}: build it with  colcon build --packages-select {NAME}")
    return 0
