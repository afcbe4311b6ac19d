"""The registry of additional interface packages; imported at start-up, so it has no dependencies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

EXAMPLES = frozenset({"action_tutorials_interfaces", "example_interfaces", "turtlesim"})
"""Standard packages of the tutorials, which a workspace package of the same name replaces. The other standard packages
are used by all.
"""

Folders = Callable[[], Mapping[str, "Path"]]
_sources: list[Folders] = []


def add_source(folders: Folders) -> None:
    """Register a source: `folders` returns package names and the folders that contain `msg`, `srv` and `action`."""
    if folders not in _sources:
        _sources.append(folders)


def added_folders() -> Mapping[str, Path]:
    """Return the added packages with their folders; for each name, the first one counts."""
    found: dict[str, Path] = {}
    for each in _sources:
        for name, folder in each().items():
            found.setdefault(name, folder)
    return found
