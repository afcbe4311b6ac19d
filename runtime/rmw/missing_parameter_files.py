"""What is said of a parameter file that does not exist: where one of that name is, by those who know packages."""

from __future__ import annotations

from collections.abc import Callable

Find = Callable[[str], str]
"""Returns a hint where a file of that path is; empty if it does not know."""

_finders: list[Find] = []


def find_with(find: Find) -> None:
    """Register a function that knows places; does nothing if it is already registered."""
    if find not in _finders:
        _finders.append(find)


def hint_for(path: str) -> str:
    """A hint where a missing parameter file is; empty if nobody knows."""
    return next((hint for find in _finders if (hint := find(path))), "")
