"""Stores the state of panes in files: alarms next to the settings, everything else in the state folder."""

from __future__ import annotations

from pathlib import Path
from zlib import crc32

from bot_console.tui.files.folders import config_folder, state_folder
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store
from bot_console.tui.settings.yaml_reader import NotPlainData, read_yaml, to_yaml

MAX_FILE_BYTES = 1_000_000
"""Maximum size of a file that is read; the console writes no larger one."""
HEADERS = {"alarms": "# Alarms of bot-console: conditions over topics and parameters, each with a name.\n"}
"""The first lines of the files that users may edit as well; these are in the settings folder."""


class StateFiles:
    """One YAML file per name; those that are not for users to edit are also separate for each system shown."""

    def __init__(self, system: str = "") -> None:
        self._system = f"{crc32(system.encode()):08x}"

    def _path(self, name: str) -> Path:
        if name in HEADERS:
            return config_folder() / f"{name}.yaml"
        return state_folder() / "left" / f"{name}-{self._system}.yaml"

    def get(self, name: str) -> object:
        """The contents of the file; None if there is none, or if it cannot be read."""
        try:
            return read_yaml(read_store(self._path(name), MAX_FILE_BYTES))
        except (OSError, NotPlainData):
            return None

    def put(self, name: str, data: object) -> str:
        """Write the file; returns why that failed, or an empty text."""
        text = HEADERS.get(name, "") + to_yaml(data, allow_unicode=True)
        try:
            save_file(self._path(name), text)
        except NotSaved as error:
            return str(error)
        return ""
