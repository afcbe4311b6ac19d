"""The history of the command line, kept between runs."""

from __future__ import annotations

import contextlib
from pathlib import Path

from bot_console.tui.files.folders import state_folder
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store

MAX_LINES = 1000
"""The number of lines kept."""
MAX_FILE_BYTES = 1 << 20
"""Bytes of the file that are read; of a larger one, only the end."""


class LineHistory:
    """The lines, newest last, and a walk through those that begin with a text or contain it."""

    def __init__(self, path: Path | None = None) -> None:
        self._path = path
        self._lines: list[str] | None = None
        self._sought: str | None = None
        """The text in the field when the walk began."""
        self._at = 0

    @property
    def file(self) -> Path:
        """The history file."""
        return self._path or state_folder() / "command-lines.txt"

    def lines(self) -> list[str]:
        """All lines; none if the file cannot be read."""
        if self._lines is None:
            self._lines = []
            with contextlib.suppress(OSError):
                text = read_store(self.file, MAX_FILE_BYTES, end=True).decode("utf-8", "replace")
                self._lines = [each for each in text.split("\n") if each.strip()][-MAX_LINES:]
        return self._lines

    def add(self, line: str) -> None:
        """Add a line; a repeated one becomes the newest. If the file cannot be written, it is kept for this run."""
        known = self.lines()
        self._lines = [*(each for each in known if each != line), line][-MAX_LINES:]
        self.restart_walk()
        with contextlib.suppress(NotSaved):
            save_file(self.file, "".join(f"{each}\n" for each in self._lines))

    def restart_walk(self) -> None:
        """Make the next step start a new walk, since the text was edited."""
        self._sought = None

    def step(self, typed: str, step: int, *, anywhere: bool = False) -> str:
        """The line before (`step` -1) or after the current one, among those that begin with what was typed.

        With `anywhere`, among those that contain it. The typed text comes after the newest line; beyond either end,
        nothing changes.
        """
        lines = self.lines()
        if self._sought is None:
            self._sought, self._at = typed, len(lines)
        sought = self._sought

        def fits(line: str) -> bool:
            return line != typed and (sought in line if anywhere else line.startswith(sought))

        at = self._at + step
        while 0 <= at < len(lines) and not fits(lines[at]):
            at += step
        if at < 0:
            return typed
        self._at = min(at, len(lines))
        return lines[at] if at < len(lines) else sought
