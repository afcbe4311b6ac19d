"""Build hook: generates the message modules, and links the folders for an editable install.

The folders are at the top of the repository but are imported as ``bot_console.<folder>``. A wheel maps them with
``sources``; hatchling cannot map an editable install, so this hook fills the git-ignored
``build/editable/bot_console`` with links to the folders instead.
"""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FOLDERS = ("tui", "runtime", "nodes", "profiles", "launch")


class CustomBuildHook(BuildHookInterface):
    """Runs before each build of the wheel (standard or editable)."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Generate ``runtime/rosidl/generated`` and, for an editable install, the links."""
        root = Path(self.root)
        subprocess.run([sys.executable, str(root / "runtime" / "rosidl" / "generate.py")], check=True, cwd=root)
        if version == "editable":
            links = root / "build" / "editable" / "bot_console"
            links.mkdir(parents=True, exist_ok=True)
            for folder in FOLDERS:
                link(root / folder, links / folder)
            # For the type checker: the package names that the importer serves.
            (root / "build" / "types").mkdir(parents=True, exist_ok=True)
            link(root / "nodes", root / "build" / "types" / "bot_console_robot")
            link(root / "nodes" / "demos", root / "build" / "types" / "bot_console_demos")


def link(target: Path, place: Path) -> None:
    """Link ``place`` to the folder ``target``: a symlink, or a directory junction on Windows."""
    if place.is_symlink() or place.exists():
        return
    if os.name == "nt":
        subprocess.run(["cmd", "/c", "mklink", "/J", str(place), str(target)], check=True)
    else:
        place.symlink_to(target, target_is_directory=True)
