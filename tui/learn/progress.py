"""A student's progress, saved in the workspace so that it moves with the workspace."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store

FOLDER = ".bot-console"
MAX_FILE_BYTES = 1_000_000
VERSION = 1


@dataclass
class Progress:
    """The conditions fulfilled in each step, the names that the student uses, and the step that was shown last."""

    path: Path
    held: dict[str, list[str]] = field(default_factory=dict[str, list[str]])
    names: dict[str, str] = field(default_factory=dict[str, str])
    at: str = ""
    problem: str = ""
    """Why the progress could not be read or saved; empty if it could."""

    def save(self) -> None:
        """Save the progress; `problem` says why that failed."""
        text = json.dumps({"version": VERSION, "at": self.at, "held": self.held, "names": self.names}, indent=1)
        try:
            save_file(self.path, text)
        except NotSaved as error:
            self.problem = f"progress is not saved: {error}"


def read_progress(workspace: Path, course: str) -> Progress:
    """The progress of a course; empty progress in a new file if the file cannot be read, which is not overwritten."""
    path = workspace / FOLDER / f"{course}.json"
    progress = Progress(path)
    try:
        found: Any = json.loads(read_store(path, MAX_FILE_BYTES))
        if found["version"] != VERSION:
            raise ValueError(f"version {found['version']} is not {VERSION}")
        for step, texts in cast("dict[str, Any]", found["held"]).items():
            progress.held[step] = [str(each) for each in texts]
        progress.names = {str(name): str(value) for name, value in found["names"].items()}
        progress.at = str(found["at"])
    except FileNotFoundError:
        pass
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        progress.problem = f"{path} cannot be read ({error}): the course starts again in a new file"
        progress.path = path.with_name(f"{course}-2.json")
    return progress
