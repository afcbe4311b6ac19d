"""Hints for parameter files given by a path within their package, as in `config_file:=config/robot.yaml`."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.package import Package

MAX_SHOWN_PLACES = 3
"""How many places a hint names at most."""


def hint_for(path: str) -> str:
    """Return a hint with the packages that have a file missing at the given relative path; empty if there are none."""
    if os.path.isabs(path):
        return ""
    packages = workspace().packages
    found = {name: each for name in sorted(packages) if (each := next(_files(packages[name], path), None))}
    named = [f"package '{name}' has {_written(file)}" for name, file in found.items()][:MAX_SHOWN_PLACES]
    return "; ".join(named)


def _files(package: Package, path: str) -> Iterator[Path]:
    """Yield the file at that path in the package, or with that name in its `config/`."""
    return (
        each for each in (package.folder / path, package.folder / "config" / os.path.basename(path)) if each.is_file()
    )


def _written(file: Path) -> str:
    """Return the path as it would be typed in the working directory."""
    here = os.path.relpath(file)
    return os.fspath(file) if here.startswith(os.pardir) else here
