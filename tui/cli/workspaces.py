"""The workspace of a run, and the launch files in it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.workspace.discover import Workspace, default_folders, use, workspace

ENDINGS = (".launch.py", ".launch.xml", ".launch.yaml", ".launch.yml", "_launch.py", "_launch.xml", "_launch.yaml")


def choose(folders: Sequence[Path]) -> None:
    """Look for packages in these folders, and in the `src/` of each, instead of the working directory."""
    if folders:
        use(Workspace([each for folder in folders for each in default_folders(folder)]))


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
