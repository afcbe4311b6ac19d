"""Hints for a parameter file that does not exist: where a file of that name is, from modules that know packages."""

from __future__ import annotations

from collections.abc import Callable

Find = Callable[[str], str]
"""Returns a hint where a file of that path is; empty if unknown."""

_finders: list[Find] = []


def find_with(find: Find) -> None:
    """Register a function that knows places; does nothing if it is already registered."""
    if find not in _finders:
        _finders.append(find)


def hint_for(path: str) -> str:
    """Return a hint where a missing parameter file is; empty if unknown."""
    return next((hint for find in _finders if (hint := find(path))), "")
