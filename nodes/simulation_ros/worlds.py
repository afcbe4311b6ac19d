"""Finds world files: by name in the package's share folder, or by path."""

from __future__ import annotations

import os
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from bot_console_robot.simulation.world import World, WorldError
from bot_console_robot.simulation.world_file import load_world

PACKAGE = "bot_console_robot"


def find_world(name: str) -> World:
    """Load the world of that name or path; raises `WorldError`, which lists the available names."""
    path = Path(name)
    if path.suffix in {".yaml", ".yml"} or len(path.parts) > 1:
        return load_world(Path(os.path.expanduser(path)))
    folder = _folder()
    if folder is None:
        raise WorldError(f"no world '{name}': the share folder of {PACKAGE} is not found; give the path of a file")
    found = folder / f"{name}.yaml"
    if not os.path.isfile(found):  # `Path` raises if the name is too long for a file.
        known = ", ".join(sorted(each.stem for each in folder.glob("*.yaml"))) or "none"
        raise WorldError(f"no world '{name}' in {folder}; there are: {known}")
    return load_world(found)


def _folder() -> Path | None:
    try:
        return Path(get_package_share_directory(PACKAGE)) / "worlds"
    except PackageNotFoundError:
        return None
