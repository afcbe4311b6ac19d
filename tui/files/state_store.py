"""The protocol by which panes keep plain data, by name, between runs, wherever it is stored."""

from __future__ import annotations

from typing import Protocol, cast

LAST_FILE = "parameter-file"
"""The name under which the path of the parameter file that was saved or opened last is stored."""


class StateStore(Protocol):
    """Stores plain data (texts, numbers, lists, mappings) by name."""

    def get(self, name: str) -> object:
        """The data stored last, possibly in an earlier run; None if there is none or it cannot be read."""
        ...

    def put(self, name: str, data: object) -> str:
        """Store data; returns why that failed, or an empty text."""
        ...


def strings_in(data: object) -> list[str]:
    """The texts in a stored list, ignoring other elements; none if the data are not a list."""
    found = cast("list[object]", data) if isinstance(data, list) else list[object]()
    return [each for each in found if isinstance(each, str)]


class MemoryStore:
    """Stores data for this run only."""

    def __init__(self) -> None:
        self._data: dict[str, object] = {}

    def get(self, name: str) -> object:
        """The data stored last in this run."""
        return self._data.get(name)

    def put(self, name: str, data: object) -> str:
        """Store data until the program ends."""
        self._data[name] = data
        return ""
