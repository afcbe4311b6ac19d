"""The workspace of a run, and the launch files in it."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.workspace.discover import Workspace, default_folders, use, workspace
from bot_console.runtime.workspace.own import FIRST_VARIABLE, NAME, PAGE_NAME, ROOT, is_own

ENDINGS = (".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml", "_launch.py", "_launch.xml", "_launch.yaml")


def choose(folders: Sequence[Path]) -> None:
    """Look for packages in these folders, and in the `src/` of each, instead of the working directory."""
    if folders:
        use(Workspace([each for folder in folders for each in default_folders(folder)]))


def launch_environment(file: str) -> dict[str, str]:
    """The environment of a launch. One of our own launch files, or none, starts our nodes whatever the workspace holds.

    That may be a package of our name, such as one that was exported and changed.
    """
    ours = not file or Path(file).resolve().parent == ROOT / "launch"
    return {**os.environ, FIRST_VARIABLE: "1"} if ours else dict(os.environ)


def tell_whose(package: str) -> None:
    """Say on stderr that a package which is named is the workspace's, where it has one of the names of ours."""
    found = workspace().packages.get(package)
    if package in (NAME, PAGE_NAME) and found is not None and not is_own(found):
        built_in = f"; the robot that comes along is '{NAME}'" if package != NAME else ", not the one that comes along"
        print(f"[INFO] [bot-console]: package '{package}' is the one in {found.folder}{built_in}", file=sys.stderr)


def launch_files() -> tuple[str, ...]:
    """The launch files of all packages."""
    found: list[str] = []
    for name in workspace().packages:
        share = workspace().share(name)
        if share:
            below = sorted(each for each in share.rglob("*") if each.name.endswith(ENDINGS) or _in_launch(each))
            found += map(str, below)
    return tuple(found)


def _in_launch(path: Path) -> bool:
    return path.parent.name == "launch" and path.suffix in (".py", ".xml", ".yaml", ".yml")
