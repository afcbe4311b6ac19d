"""Parameter files of packages that were named by a path of theirs, as in `config_file:=config/robot.yaml`."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.package import Package

SHOWN = 3
"""Places that a hint names at most."""


def hint_for(path: str) -> str:
    """The hint which packages have a file that does not exist at a relative path; empty if none has."""
    if os.path.isabs(path):
        return ""
    packages = workspace().packages
    found = {name: each for name in sorted(packages) if (each := next(_files(packages[name], path), None))}
    named = [f"package '{name}' has {_written(file)}" for name, file in found.items()][:SHOWN]
    return "; ".join(named)


def _files(package: Package, path: str) -> Iterator[Path]:
    """The file at that path of the package, or of that name in its `config/`."""
    return (
        each for each in (package.folder / path, package.folder / "config" / os.path.basename(path)) if each.is_file()
    )


def _written(file: Path) -> str:
    """The path as it would be typed here."""
    here = os.path.relpath(file)
    return os.fspath(file) if here.startswith(os.pardir) else here
