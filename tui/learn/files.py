"""The files and packages of a student's workspace, for conditions."""

from __future__ import annotations

import fnmatch
import os
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path

from bot_console.runtime.workspace.discover import Workspace, default_folders
from bot_console.runtime.workspace.package import Package
from bot_console.tui.files.store_file import read_store

SKIPPED = frozenset(("build", "install", "log", "__pycache__", "node_modules"))
MAX_FILES = 5000
"""Maximum number of files of a workspace that are listed."""
MAX_FILE_BYTES = 1_000_000


class WorkspaceFiles:
    """The state of a workspace when this object was made; later changes need another one."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._files = sorted(_below(folder))
        self.stamp = hash(tuple((str(each), _changed(each)) for each in self._files))
        """A hash that changes when a file of the workspace is added, removed or written."""

    def matching(self, pattern: str) -> list[Path]:
        """The files whose path within the workspace ends with a shell pattern such as `config/*.yaml`."""
        wanted = f"*/{pattern.lstrip('/')}"
        return [each for each in self._files if fnmatch.fnmatch(f"/{each.relative_to(self.folder)}", wanted)]

    def newest(self, found: Sequence[Path]) -> Path:
        """The file that was written last: the one that is being worked on."""
        return max(found, key=_changed)

    def launch_files_named(self, word: str) -> list[tuple[str, str]]:
        """The path and text of each Python, XML or YAML file that a word of a launch command may name."""
        if not word.endswith((".py", ".xml", ".yaml", ".yml")):
            return []
        return [(self.relative_path(each), self.text(each)) for each in self.matching(os.path.basename(word))]

    def text(self, path: Path) -> str:
        """The text of a file; empty if it cannot be read or is too large."""
        try:
            return read_store(path, MAX_FILE_BYTES).decode("utf-8", "replace")
        except OSError:
            return ""

    @cached_property
    def packages(self) -> list[Package]:
        """The packages, most recently changed first."""
        found = Workspace(list(default_folders(self.folder))).packages.values()
        root = self.folder.resolve()
        inside = [each for each in found if root in (each.folder.resolve(), *each.folder.resolve().parents)]
        return sorted(inside, key=lambda each: -_changed(each.folder))

    def package_name(self, usual: str) -> str:
        """The name of the student's package: `usual` if it exists or nothing else does, else the one changed last."""
        found = [each.name for each in self.packages]
        return usual if usual in found else next(iter(found), usual)

    def relative_path(self, path: Path) -> str:
        """The path of a file within the workspace, for messages."""
        return str(path.relative_to(self.folder))


def _below(folder: Path) -> Iterator[Path]:
    count = 0
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(each for each in folders if each not in SKIPPED and not each.startswith("."))
        for each in files:
            count += 1
            if count > MAX_FILES:
                return
            yield Path(place) / each


def _changed(path: Path) -> float:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0
