"""What panes keep from run to run: plain data by name. Where it is kept is not their business."""

from __future__ import annotations

from typing import Protocol

LAST_FILE = "parameter-file"
"""The name of the parameter file that was saved or opened last; its path is kept whole."""


class Kept(Protocol):
    """Plain data (texts, numbers, lists, mappings) by name."""

    def get(self, name: str) -> object:
        """What was put there last, also in an earlier run; None where nothing was, or where it cannot be read."""
        ...

    def put(self, name: str, data: object) -> str:
        """Keep data; gives why that could not be done, empty when it could."""
        ...


class KeptHere:
    """Keeps data for this run only."""

    def __init__(self) -> None:
        self._data: dict[str, object] = {}

    def get(self, name: str) -> object:
        """What was put there last."""
        return self._data.get(name)

    def put(self, name: str, data: object) -> str:
        """Keep it while the program runs."""
        self._data[name] = data
        return ""
