"""The protocol of what panes remember between runs: plain data by name. Where it is stored is not their concern."""

from __future__ import annotations

from typing import Protocol, cast

LAST_FILE = "parameter-file"
"""The name of the parameter file that was saved or opened last; its path is kept whole."""


class StateStore(Protocol):
    """Plain data (texts, numbers, lists, mappings) by name."""

    def get(self, name: str) -> object:
        """The value stored last, in an earlier run too; None where there is nothing, or it cannot be read."""
        ...

    def put(self, name: str, data: object) -> str:
        """Store data; returns why that failed, and an empty text when it did not."""
        ...


def texts_in(data: object) -> list[str]:
    """The texts of a stored list, without anything else in it; none if it is no list."""
    found = cast("list[object]", data) if isinstance(data, list) else list[object]()
    return [each for each in found if isinstance(each, str)]


class MemoryStore:
    """Stores data for this run only."""

    def __init__(self) -> None:
        self._data: dict[str, object] = {}

    def get(self, name: str) -> object:
        """The value stored last."""
        return self._data.get(name)

    def put(self, name: str, data: object) -> str:
        """Store it while the program runs."""
        self._data[name] = data
        return ""
