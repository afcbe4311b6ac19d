"""The included package `bot_console_robot`: the folders `nodes/`, `launch/` and `profiles/`."""

from __future__ import annotations

import os
from pathlib import Path
from types import MappingProxyType

from bot_console.runtime.workspace.package import EntryPoint, Package
from bot_console.runtime.workspace.share import link

NAME = "bot_console_robot"
PAGE_NAME = "intelligent_robot"
"""A second name of the same package, used by courses; valid unless another package has that name."""
ROOT = Path(__file__).resolve().parents[2]
"""The folder that contains `nodes/`, `launch/` and `profiles/`, in a checkout and in an installed wheel."""
FIRST_VARIABLE = "BOT_CONSOLE_ROBOT_FIRST"
"""Environment variable that is set in our own launches, and so in their processes: our package then precedes others of
its name.
"""

SECOND_SPELLING = "environment_launch.py"
"""The name that courses use for `environment.launch.py`."""


def own_package() -> Package:
    """Return the package as if it had been read from a source folder: each `*_node.py` is an executable."""
    nodes = ROOT / "nodes"
    names = sorted(each.stem for each in nodes.glob("*_node.py"))
    entry_points = {name: EntryPoint(f"{NAME}.{name}", "main") for name in names}
    return Package(NAME, nodes, "ament_python", executables=MappingProxyType(entry_points))


def is_own(package: Package) -> bool:
    """Whether a package is the included one, not a user's package of the same name."""
    return package.folder == ROOT / "nodes"


def own_is_first() -> bool:
    """Whether the calling process belongs to one of our own launches."""
    return bool(os.environ.get(FIRST_VARIABLE))


def own_share(links: Path) -> Path:
    """Return the package's share folder: `launch/`, `config/` with each profile under both its names, and `worlds/`."""
    place = links / NAME
    for path in (ROOT / "launch").glob("*.launch.*"):
        link(path, place / "launch" / path.name)
    link(ROOT / "launch" / "environment.launch.py", place / "launch" / SECOND_SPELLING)
    for path in (ROOT / "profiles").glob("*.yaml"):
        link(path, place / "config" / path.name)
        link(path, place / "config" / f"{path.stem}_config.yaml")
    for path in (ROOT / "profiles" / "worlds").glob("*.yaml"):
        link(path, place / "worlds" / path.name)
    return place
