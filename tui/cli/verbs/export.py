"""`bot-console export DIR`: writes the robot's package for a machine with ROS 2 and colcon."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from bot_console.runtime.programs.exit_messages import place_fault
from bot_console.tui.files.save_file import NotSaved, save_file, typed_path


def run(words: list[str]) -> int:
    """Write the package and print its path; ask before writing into an existing folder."""
    parser = argparse.ArgumentParser("bot-console export", description="Write the robot's package for colcon.")
    parser.add_argument("folder", metavar="DIR", help="folder to create the package in, such as ~/ros2_ws/src")
    given = parser.parse_args(words)
    from bot_console.runtime.workspace.exporting import NAME, export

    try:
        place = typed_path(given.folder).resolve() / NAME
        with TemporaryDirectory() as scratch:
            made = export(Path(scratch))
            names = sorted(each.relative_to(made) for each in made.rglob("*") if each.is_file())
            kept = [each for each in names if _differs(made / each, place / each)]
            if place.exists() and not _agreed(place, kept):
                raise NotSaved(f"{place} exists already; give another folder")
            for each in names:
                if each in kept:
                    save_file(_free_name(place / each), (place / each).read_bytes())
                save_file(place / each, (made / each).read_bytes())
    except (OSError, ValueError) as error:
        parser.exit(1, f"not exported: {place_fault(error) or error}\n")
    print(f"{place}: build it with  colcon build --packages-select {NAME}")
    return 0


def _differs(new: Path, old: Path) -> bool:
    return old.is_file() and old.read_bytes() != new.read_bytes()


def _agreed(place: Path, kept: list[Path]) -> bool:
    """Ask whether to write into an existing folder; without a terminal, the answer is no."""
    if not sys.stdin.isatty():
        return False
    print(f"{place} exists already. Nothing in it is deleted.")
    if kept:
        print("These differ, and are kept with ~ appended to their names: " + ", ".join(map(str, kept)))
    try:
        return input("Write the package into it? [y/N] ").strip().lower() in ("y", "yes")
    except EOFError:
        return False


def _free_name(path: Path) -> Path:
    """An unused path for the old content: `x.py~`, `x.py~~` ..."""
    while path.exists():
        path = path.with_name(path.name + "~")
    return path
